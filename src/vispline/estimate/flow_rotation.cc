#include "vispline/estimate/flow_rotation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "vispline/core/so3.h"

namespace vispline {
namespace {

constexpr std::size_t kFewestPairs = 8;
constexpr int kRounds = 12;

struct Pair {
  Vector3d before, after;  ///< bearings in the camera at the two frames
};

std::vector<Pair> pairs_of(const Camera& camera, const std::vector<Feature>& before,
                           const std::vector<Feature>& after) {
  std::map<std::uint64_t, Vector2d> earlier;
  for (const Feature& feature : before) earlier[feature.id] = feature.px;
  std::vector<Pair> pairs;
  for (const Feature& feature : after) {
    const auto found = earlier.find(feature.id);
    if (found == earlier.end()) continue;
    const auto a = camera.lens.unproject(found->second), b = camera.lens.unproject(feature.px);
    if (a && b) pairs.push_back({*a, *b});
  }
  return pairs;
}

/// theta with after = exp(-theta) before for most pairs; residuals beyond their median weigh ever less.
std::optional<Vector3d> turn_between(const std::vector<Pair>& pairs) {
  if (pairs.size() < kFewestPairs) return std::nullopt;
  Vector3d theta = Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    const Matrix3d R = SO3::exp<double>(theta);
    std::vector<double> size;
    for (const Pair& p : pairs) size.push_back((R * p.after - p.before).squaredNorm());
    std::vector<double> sorted = size;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double scale = std::max(*middle, 1e-16);
    Matrix3d H = Matrix3d::Zero();
    Vector3d g = Vector3d::Zero();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Vector3d turned = R * pairs[i].after;
      const Matrix3d J = -hat(turned);  // R after moves by delta x (R after), delta in the earlier frame
      const double weight = 1.0 / (1.0 + size[i] / scale);
      H += weight * J.transpose() * J;
      g += weight * J.transpose() * (turned - pairs[i].before);
    }
    const Vector3d step = -H.ldlt().solve(g);
    if (!step.allFinite()) return std::nullopt;
    theta = SO3::log<double>(Matrix3d(SO3::exp<double>(step) * R));
  }
  return theta;
}

}  // namespace

ImuSignal turning_rate(const Camera& camera, const FeatureSignal& features) {
  ImuSignal rates;
  const double middle_s = 0.5 * camera.shutter.line_delay_s * camera.shutter.lines(camera.resolution_px);
  for (std::size_t f = 1; f < features.size(); ++f) {
    const auto theta = turn_between(pairs_of(camera, features.value[f - 1], features.value[f]));
    if (!theta) continue;
    const Duration step = features.time[f] - features.time[f - 1];
    rates.push_back(features.time[f - 1] + step / 2 + from_seconds(middle_s),
                    {*theta / to_seconds(step), Vector3d::Zero()});
  }
  return rates;
}

}  // namespace vispline
