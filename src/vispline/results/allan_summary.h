/// What the axes of one sensor have in common: mean and worst of each noise term, for tables and calibration files.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "vispline/allan/result.h"

namespace vispline {

/// One term over the axes of a sensor. Axes that never change count for nothing.
struct TermSummary {
  std::vector<std::string> resolved_axes, unresolved_axes;
  std::optional<double> mean, worst;      ///< arithmetic mean and largest value of the resolved axes
  std::string worst_axis;                 ///< empty if there is no worst
  std::optional<double> upper_bound;      ///< the largest of the unresolved axes; none if one of them has none
  std::optional<double> record_needed_s;  ///< likewise
  bool resolved() const { return unresolved_axes.empty() && !resolved_axes.empty(); }
  /// The largest value an axis can have by this record: worst, or the bound if it is larger; none if one is unbounded.
  std::optional<double> limit() const;
};

struct SensorSummary {
  std::string sensor, unit;          ///< as in SignalAnalysis
  std::vector<std::size_t> signals;  ///< indices into AllanResult::signals
  std::array<TermSummary, kTerms> term;
  std::optional<double> imu_utils_n, imu_utils_w;  ///< mean over the axes, as imu_utils prints it; unit
  TermSummary& operator[](Term t) { return term[static_cast<std::size_t>(t)]; }
  const TermSummary& operator[](Term t) const { return term[static_cast<std::size_t>(t)]; }
};

/// One for each sensor, in the order of the signals.
std::vector<SensorSummary> summarize(const AllanResult& result);

/// The curve that the terms were fitted to, to be held against NoiseTerms::deviation: overlapping Allan, else Allan,
/// else total; nullptr if the signal has none of these.
const AllanCurve* fitted_curve(const SignalAnalysis& signal);

/// Whether a bound on a term says more than the curve itself: at the end of the curve where the term is strongest, the
/// bounded term lies below the curve.
bool useful_bound(const SignalAnalysis& signal, Term term);

/// Standard deviation [unit] at each sample of white noise, N sqrt(rate), and of one step of a bias random walk,
/// K / sqrt(rate); none for the other terms, which have no such number, and none without a value.
std::optional<double> discrete_sigma(Term term, const std::optional<double>& coefficient, double rate_hz);

}  // namespace vispline
