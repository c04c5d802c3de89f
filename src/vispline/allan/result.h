/// What an Allan analysis found: curves, noise terms with intervals, and what other tools would print. Plain values.
/// docs/math/allan.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/allan/deviation.h"
#include "vispline/core/error.h"
#include "vispline/core/time.h"

namespace vispline {

/// One curve. All vectors are as long as tau_s; low and high bound the deviation with confidence kCurveConfidence.
struct AllanCurve {
  Deviation deviation = Deviation::kOadev;
  bool exact = true;  ///< false: every start of a difference counts only at small tau (bounded memory)
  std::vector<double> tau_s;
  std::vector<double> value;        ///< [unit]
  std::vector<double> low, high;    ///< [unit]
  std::vector<double> edf;          ///< equivalent degrees of freedom
  std::vector<std::int64_t> count;  ///< differences in the sum
};

inline constexpr double kCurveConfidence = 0.683;

/// The noise terms, by the slope of their deviation: -1, -1/2, 0, +1/2, +1.
enum class Term : std::size_t { kQuantization, kWhite, kFlicker, kRandomWalk, kRamp };
inline constexpr std::size_t kTerms = 5;

/// "quantization", "white", "flicker", "random_walk", "ramp".
std::string_view name_of(Term term);
/// "Q", "N", "B", "K", "R".
std::string_view symbol_of(Term term);
/// Unit of the coefficient for a signal in `unit` (rad/s or m/s^2): N of a gyroscope is rad/s/sqrt(Hz).
std::string unit_of(Term term, std::string_view unit);
/// Allan deviation [unit] of one term alone. docs/math/allan.md (9).
double deviation_of(Term term, double coefficient, double tau_s);

/// One coefficient. If it is resolved: value with two-sided intervals. If not: no value, but a bound (if the record
/// gives one) and how long a record of this kind must be to find, nine times out of ten, a coefficient half as large as
/// that bound.
struct TermEstimate {
  bool resolved = false;
  double value = 0.0;  ///< 0 if not resolved
  double low_68 = 0.0, high_68 = 0.0;
  double low_95 = 0.0, high_95 = 0.0;
  std::optional<double> upper_bound;  ///< upper end of the 95 % interval that starts at 0
  std::optional<double> record_needed_s;
  double significance = 0.0;  ///< twice the log-likelihood lost without the term
};

struct NoiseTerms {
  std::array<TermEstimate, kTerms> term;
  TermEstimate& operator[](Term t) { return term[static_cast<std::size_t>(t)]; }
  const TermEstimate& operator[](Term t) const { return term[static_cast<std::size_t>(t)]; }
  /// Allan deviation [unit] of the resolved terms together.
  double deviation(double tau_s) const;
  /// sqrt(3) N / K, where white noise and random walk cross with slope; only if both are resolved.
  std::optional<double> tau_star_s() const;
};

/// A frequency octave where the terms do not describe the spectrum; the fit gives it less weight.
struct ModelMisfit {
  double low_hz = 0.0, high_hz = 0.0;
  double ratio = 1.0;  ///< measured power / power of the fitted terms
};

struct MinimumDeviation {
  double tau_s = 0.0, deviation = 0.0;
};

/// What imu_utils prints for this record, by its own recipe. docs/math/allan.md, imu_utils.
struct ImuUtilsNumbers {
  double n = 0.0;                        ///< gyr_n, acc_n: discrete standard deviation at the rate, unit
  double w = 0.0;                        ///< gyr_w, acc_w: smallest fitted deviation, unit; neither K nor B
  double w_tau_s = 0.0;                  ///< where that minimum lies
  std::vector<double> tau_s;             ///< its cluster times
  std::vector<double> measured, fitted;  ///< its curves [unit], as long as tau_s
};

struct SignalAnalysis {
  std::string sensor;                           ///< "gyroscope", "accelerometer" or "series"
  std::string axis;                             ///< "x", "y", "z" or empty
  std::string unit;                             ///< "rad/s", "m/s^2" or empty
  double mean = 0.0, standard_deviation = 0.0;  ///< of all readings, unit
  bool constant = false;                        ///< the axis never changes: nothing below is filled
  std::vector<AllanCurve> curves;
  NoiseTerms terms;
  std::vector<ModelMisfit> misfits;
  MinimumDeviation minimum;  ///< of the overlapping Allan curve (the first curve if there is none)
  ImuUtilsNumbers imu_utils;
};

struct AllanResult {
  double rate_hz = 0.0;
  double duration_s = 0.0;  ///< sum over the segments
  std::int64_t samples = 0;
  std::int64_t segments = 0;  ///< gap-free, at least 2 samples long
  std::vector<SignalAnalysis> signals;
  Diagnostics diagnostics;  ///< motion, drift, spikes, gaps, quantum, length, held samples
};

}  // namespace vispline
