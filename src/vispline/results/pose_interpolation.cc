#include "vispline/results/pose_interpolation.h"

#include <algorithm>
#include <array>

#include "vispline/core/se3.h"

namespace vispline {
namespace {

constexpr double kMaxStepRatio = 2.0;
constexpr double kHalfNanosecond = 5e-10;  // s, the rounding of a limit that is a whole number of steps

/// The cubic needs a pose on either side of the two neighbours i and i + 1, at steps of similar length.
bool has_even_neighbours(const Signal<Pose>& poses, std::size_t i) {
  if (i == 0 || i + 2 >= poses.size()) return false;
  const double before = to_seconds(poses.time[i] - poses.time[i - 1]);
  const double inside = to_seconds(poses.time[i + 1] - poses.time[i]);
  const double after = to_seconds(poses.time[i + 2] - poses.time[i + 1]);
  const auto [shortest, longest] = std::minmax({before, inside, after});
  return longest <= kMaxStepRatio * shortest;
}

/// Twist of pose k seen from pose i.
Vector6d twist_from(const Signal<Pose>& poses, std::size_t i, std::size_t k) {
  return SE3::log<double>(poses.value[i].inverse() * poses.value[k]);
}

Vector6d geodesic_twist(const Signal<Pose>& poses, std::size_t i, Time time) {
  const double u = to_seconds(time - poses.time[i]) / to_seconds(poses.time[i + 1] - poses.time[i]);
  return u * twist_from(poses, i, i + 1);
}

/// Lagrange's cubic through the twists of the poses i - 1 .. i + 2; that of pose i is zero.   docs/math/evaluate.md (3)
Vector6d cubic_twist(const Signal<Pose>& poses, std::size_t i, Time time) {
  std::array<double, 4> s;
  for (std::size_t k = 0; k < 4; ++k) s[k] = to_seconds(poses.time[i - 1 + k] - time);
  Vector6d twist = Vector6d::Zero();
  for (const std::size_t k : {0u, 2u, 3u}) {
    double weight = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j != k) weight *= s[j] / (s[j] - s[k]);
    }
    twist += weight * twist_from(poses, i, i - 1 + k);
  }
  return twist;
}

}  // namespace

std::optional<Pose> interpolate_pose(const Signal<Pose>& poses, Time time, double max_gap_s) {
  const auto after = std::upper_bound(poses.time.begin(), poses.time.end(), time);
  if (after == poses.time.begin()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - poses.time.begin()) - 1;
  if (poses.time[i] == time) return poses.value[i];
  if (after == poses.time.end() || to_seconds(*after - poses.time[i]) > max_gap_s + kHalfNanosecond)
    return std::nullopt;
  const Vector6d twist = has_even_neighbours(poses, i) ? cubic_twist(poses, i, time) : geodesic_twist(poses, i, time);
  return poses.value[i] * SE3::exp<double>(twist);
}

}  // namespace vispline
