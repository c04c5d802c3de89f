/// Words and numbers that the terminal and the report share when they speak of an Allan analysis.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/allan/result.h"
#include "vispline/results/allan_summary.h"

namespace vispline {

/// "1.70e-04": always with exponent and point, the same in every locale; "-" if it is not a finite number.
std::string scientific_text(const std::optional<double>& value, int digits = 3);
/// "0.58", "5.8", "58", "580": two figures of a share in per cent, without exponent; "-" if not finite.
std::string percent_text(double percent);
/// "90 s", "75 min", "14 h", "5 days".
std::string duration_text(double seconds);

/// Kalibr's key: gyroscope_noise_density, accelerometer_random_walk, ...; empty for other sensors and terms.
std::string kalibr_key(std::string_view sensor, Term term);
/// Kalibr's key if there is one, else sensor and symbol: "series N".
std::string quantity_name(std::string_view sensor, Term term);

/// "K of gyroscope x: not observable in this record, < 3.1e-05 rad/s^2/sqrt(Hz); a record of about 14 h would resolve
/// it." Precondition: some axis does not resolve the term.
std::string unresolved_text(const SensorSummary& sensor, Term term);

/// The terms that a reader should hear of although they are not resolved: N, K and B always, Q and R if some unresolved
/// axis has a useful_bound.
std::vector<Term> unresolved_terms(const AllanResult& result, const SensorSummary& sensor);

/// Unit of the values of a curve of this kind for a signal in `unit`: the time deviation has one more second.
std::string curve_unit(Deviation kind, std::string_view unit);

}  // namespace vispline
