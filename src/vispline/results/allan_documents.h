/// An Allan analysis as a JSON document, as text for a terminal, as a table of its curves and as lines for Kalibr.
/// Keys and units: docs/json.md.
#pragma once

#include <string>

#include "vispline/allan/result.h"
#include "vispline/results/json.h"

namespace vispline {

/// vispline.allan/1. What was not found is null, never 0.
std::string allan_json(const AllanResult& result, const JsonContext& context);

/// Tables of the terms with intervals, Kalibr's quantities beside their discrete sigmas, what is not observable, and
/// what imu_utils would print. Diagnostics are not in it.
std::string allan_text(const AllanResult& result);

/// CSV: tau_s, then value, low, high, count for each curve of each signal and, for Allan and total deviations, the fit
/// of the terms. Units stand in the header. A row for every tau of any curve; cells without a value are empty.
std::string allan_curve_csv(const AllanResult& result);

/// The noise of gyroscope and accelerometer in Kalibr's imu.yaml: the worst axis of each, unit and mean above it in a
/// comment. An axis that does not resolve a quantity counts with its bound, and the comment says so; without a bound
/// the line is a comment. The key rostopic is the reader's to add.
std::string allan_kalibr_yaml(const AllanResult& result);

}  // namespace vispline
