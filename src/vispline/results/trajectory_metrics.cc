#include "vispline/results/trajectory_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "vispline/core/so3.h"
#include "vispline/results/gaps.h"

namespace vispline {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

double angle_deg(const Matrix3d& R) { return kDegrees * SO3::log<double>(R).norm(); }

double root_mean_square(const std::vector<double>& values) {
  const double sum = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double median(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Where each pair is on the axis along which deltas are measured: seconds, or metres along the reference.
std::vector<double> stations(const std::vector<PosePair>& pairs, DeltaUnit unit) {
  std::vector<double> station(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    station[i] = unit == DeltaUnit::kSeconds
                     ? to_seconds(pairs[i].time - pairs[0].time)
                     : station[i - 1] + (pairs[i].T_w_b_reference.p - pairs[i - 1].T_w_b_reference.p).norm();
  }
  return station;
}

/// First index after `i` whose station is nearest to `target`; `station` does not decrease. Precondition: i is not
/// last.
std::size_t nearest_after(const std::vector<double>& station, std::size_t i, double target) {
  const auto begin = station.begin() + static_cast<std::ptrdiff_t>(i) + 1;
  auto best = std::lower_bound(begin, station.end(), target);
  if (best == station.end() || (best != begin && target - *(best - 1) <= *best - target)) {
    best = std::lower_bound(begin, station.end(), *(best - 1));
  }
  return static_cast<std::size_t>(best - station.begin());
}

/// docs/math/evaluate.md (12)-(14)
RelativeError relative_error(const TrajectoryComparison& comparison, RelativeDelta delta, double tolerance) {
  const std::vector<PosePair>& pairs = comparison.association.pairs;
  const std::vector<double> station = stations(pairs, delta.unit);
  std::vector<double> translation_m, rotation_deg;
  for (std::size_t i = 0; i + 1 < pairs.size(); ++i) {
    const std::size_t j = nearest_after(station, i, station[i] + delta.value);
    if (std::abs(station[j] - station[i] - delta.value) > tolerance * delta.value) continue;
    const Pose Q = pairs[i].T_w_b_reference.inverse() * pairs[j].T_w_b_reference;
    Pose P = pairs[i].T_w_b_estimate.inverse() * pairs[j].T_w_b_estimate;
    P.p *= comparison.alignment.scale;
    const Pose E = Q.inverse() * P;
    translation_m.push_back(E.p.norm());
    rotation_deg.push_back(angle_deg(E.R));
  }
  RelativeError error{.delta = delta,
                      .pairs = static_cast<std::int64_t>(translation_m.size()),
                      .translation_rmse_m = {},
                      .rotation_rmse_deg = {}};
  if (translation_m.empty()) return error;
  error.translation_rmse_m = root_mean_square(translation_m);
  error.rotation_rmse_deg = root_mean_square(rotation_deg);
  return error;
}

Alignment align_pairs(AlignmentMode mode, const std::vector<PosePair>& pairs) {
  std::vector<Vector3d> points_e, points_r;
  for (const PosePair& pair : pairs) {
    points_e.push_back(pair.T_w_b_estimate.p);
    points_r.push_back(pair.T_w_b_reference.p);
  }
  return align(mode, points_e, points_r);
}

/// docs/math/evaluate.md (9)-(11)
void fill_absolute_error(TrajectoryComparison& comparison) {
  std::vector<double> position_m, rotation_deg;
  for (const PosePair& pair : comparison.association.pairs) {
    const Pose T_r_b = comparison.alignment * pair.T_w_b_estimate;
    position_m.push_back((T_r_b.p - pair.T_w_b_reference.p).norm());
    rotation_deg.push_back(angle_deg(pair.T_w_b_reference.R.transpose() * T_r_b.R));
  }
  comparison.position_m = error_statistics(std::move(position_m));
  comparison.rotation_rmse_deg = root_mean_square(rotation_deg);
  comparison.rotation_max_deg = *std::max_element(rotation_deg.begin(), rotation_deg.end());
}

void warn_unpaired(TrajectoryComparison& comparison, std::size_t estimates) {
  const Association& found = comparison.association;
  if (found.estimate_outside + found.estimate_unmatched == 0) return;
  comparison.diagnostics.add(
      {.code = "W-UNPAIRED",
       .message =
           std::to_string(found.estimate_outside + found.estimate_unmatched) + " of " + std::to_string(estimates) +
           " poses of the estimate have no reference: " + std::to_string(found.estimate_outside) +
           " outside its span, " + std::to_string(found.estimate_unmatched) + " in its gaps or beyond the tolerance",
       .where = "",
       .effect = "those poses were not compared",
       .next = "check the clocks of both files, or allow longer gaps"});
}

}  // namespace

ErrorStatistics error_statistics(std::vector<double> errors) {
  if (errors.empty()) return {};
  const auto n = static_cast<double>(errors.size());
  ErrorStatistics s;
  s.rmse = root_mean_square(errors);
  s.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / n;
  for (const double error : errors) s.std += (error - s.mean) * (error - s.mean);
  s.std = std::sqrt(s.std / n);
  s.median = median(errors);
  s.max = errors.back();
  return s;
}

TrajectoryComparison compare_trajectories(const Signal<Pose>& estimate, const Signal<Pose>& reference,
                                          const TrajectoryCompareOptions& options) {
  require(!estimate.empty() && !reference.empty(), "an estimate and a reference of at least one pose");
  for (const RelativeDelta& delta : options.deltas) require(delta.value > 0.0, "deltas above 0 for the relative error");
  TrajectoryComparison comparison;
  comparison.association = associate(estimate, reference, options.association);
  const std::vector<PosePair>& pairs = comparison.association.pairs;
  if (pairs.empty()) {
    throw_no_overlap("the estimate", estimate.span(), "the reference", reference.span(),
                     "check that both files use the same clock and time unit");
  }
  comparison.alignment_mode = options.alignment;
  comparison.alignment = align_pairs(options.alignment, pairs);
  comparison.duration_s = to_seconds(pairs.back().time - pairs.front().time);
  comparison.path_length_m = stations(pairs, DeltaUnit::kMetres).back();
  fill_absolute_error(comparison);
  for (const RelativeDelta& delta : options.deltas) {
    comparison.relative.push_back(relative_error(comparison, delta, options.delta_tolerance));
  }
  warn_unpaired(comparison, estimate.size());
  return comparison;
}

}  // namespace vispline
