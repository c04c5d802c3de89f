#include "vispline/results/association.h"

#include <algorithm>

#include "vispline/core/error.h"
#include "vispline/results/gaps.h"
#include "vispline/results/pose_interpolation.h"

namespace vispline {
namespace {

constexpr double kGapPeriods = 3.0;
constexpr double kGapFloor = 0.1;  // s

/// Index of the stamp nearest to `time`, the earlier one of two. Precondition: not empty.
std::size_t nearest(const std::vector<Time>& stamps, Time time) {
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), time);
  const auto i = static_cast<std::size_t>(after - stamps.begin());
  if (i == 0) return 0;
  if (i == stamps.size()) return i - 1;
  return time - stamps[i - 1] <= stamps[i] - time ? i - 1 : i;
}

void count_missing(Association& association, const Signal<Pose>& reference, Time time) {
  const bool inside = !reference.empty() && reference.span().contains(time);
  ++(inside ? association.estimate_unmatched : association.estimate_outside);
}

std::optional<Pose> nearest_pose(const Signal<Pose>& estimate, const Signal<Pose>& reference, std::size_t i,
                                 double tolerance_s) {
  if (reference.empty()) return std::nullopt;
  const std::size_t j = nearest(reference.time, estimate.time[i]);
  if (nearest(estimate.time, reference.time[j]) != i) return std::nullopt;
  if (std::chrono::abs(reference.time[j] - estimate.time[i]) > from_seconds(tolerance_s)) return std::nullopt;
  return reference.value[j];
}

}  // namespace

Association associate(const Signal<Pose>& estimate, const Signal<Pose>& reference, const AssociationOptions& options) {
  require(options.tolerance_s >= 0.0, "an association tolerance of at least 0 s");
  require(options.max_gap_s.value_or(1.0) > 0.0, "a largest gap above 0 s");
  const bool interpolates = options.mode == AssociationMode::kInterpolate;
  const double max_gap_s = options.max_gap_s.value_or(gap_limit_s(reference.time, kGapPeriods, kGapFloor));
  Association association;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Time time = estimate.time[i];
    const std::optional<Pose> pose = interpolates ? interpolate_pose(reference, time, max_gap_s)
                                                  : nearest_pose(estimate, reference, i, options.tolerance_s);
    if (pose) {
      association.pairs.push_back({time, estimate.value[i], *pose});
    } else {
      count_missing(association, reference, time);
    }
  }
  if (!interpolates) {
    association.reference_unmatched = static_cast<std::int64_t>(reference.size() - association.pairs.size());
  }
  return association;
}

}  // namespace vispline
