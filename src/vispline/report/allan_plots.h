/// Drawings of an Allan analysis: curves with intervals, the terms under a curve, what is left over, imu_utils.
#pragma once

#include <string>

#include "vispline/allan/result.h"
#include "vispline/report/plot.h"
#include "vispline/results/allan_summary.h"

namespace vispline::report {

/// "rad/s/√Hz", "m/s²": a unit of the results as a page writes it.
std::string pretty_unit(std::string unit);

/// The curves of one kind of deviation of all axes of a sensor, each with its interval; both axes logarithmic.
Plot curves_plot(const AllanResult& result, const SensorSummary& sensor, Deviation kind);

/// The curve of one axis, each resolved term alone with its name and slope, and the terms together.
/// Precondition: fitted_curve(signal).
Plot terms_plot(const SignalAnalysis& signal);

/// Measured over fitted deviation of one axis, less one, in per cent with its interval. Precondition: fitted_curve
/// (signal) and a resolved term.
Plot residual_plot(const SignalAnalysis& signal);

/// What imu_utils measures and fits beside our curve, its two numbers marked. Precondition: signal.imu_utils.tau_s is
/// not empty.
Plot imu_utils_plot(const SignalAnalysis& signal, double rate_hz);

}  // namespace vispline::report
