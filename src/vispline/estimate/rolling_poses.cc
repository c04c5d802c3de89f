#include "vispline/estimate/rolling_poses.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "vispline/core/so3.h"
#include "vispline/estimate/flow_rotation.h"
#include "vispline/estimate/gyro_rotation.h"
#include "vispline/results/imu_comparison.h"

namespace vispline {
namespace {

constexpr double kLeastCorrelation = 0.5;
constexpr int kRounds = 5;
constexpr std::size_t kFewestPoints = 6;
constexpr double kMostRms_px = 15.0;

/// The camera's attitude in the world of the gyroscope.
struct Turning {
  GyroRotation R_w_b;
  Matrix3d R_b_c;
  double offset_s;
  double correlation;

  Matrix3d R_w_c(Time stamp, double extra_s) const { return R_w_b(stamp + from_seconds(extra_s + offset_s)) * R_b_c; }
};

std::optional<Turning> turning_of(const Camera& camera, const FeatureSignal& features, const ImuSignal& imu) {
  const ImuSignal rates = turning_rate(camera, features);
  if (rates.size() < 20) return std::nullopt;
  const ImuComparison compared = compare_imu(rates, imu);
  if (!compared.aligned || compared.offset_correlation < kLeastCorrelation) return std::nullopt;
  Vector3d bias;
  for (std::size_t a = 0; a < 3; ++a) bias(static_cast<Eigen::Index>(a)) = compared.gyroscope[a].mean;
  return Turning{GyroRotation(imu, bias), compared.R_second_first, compared.time_offset_s, compared.offset_correlation};
}

/// The rotation nearest to most of `rotations`: those far from the mean weigh ever less.
Matrix3d middle_of(const std::vector<Matrix3d>& rotations) {
  Matrix3d mean = rotations[rotations.size() / 2];
  for (int round = 0; round < 3 * kRounds; ++round) {
    Vector3d sum = Vector3d::Zero();
    double weights = 0.0;
    for (const Matrix3d& R : rotations) {
      const Vector3d turn = SO3::log<double>(Matrix3d(mean.transpose() * R));
      const double weight = 1.0 / std::max(turn.norm(), 1e-3);
      sum += weight * turn;
      weights += weight;
    }
    mean = mean * SO3::exp<double>(Vector3d(sum / weights));
  }
  return mean;
}

}  // namespace

std::optional<RollingPoses> rolling_poses(const Camera& camera, const FeatureSignal& features,
                                          const TargetPoints& target, const Signal<Pose>& T_t_c, const ImuSignal& imu) {
  const auto turning = turning_of(camera, features, imu);
  if (!turning || T_t_c.empty()) return std::nullopt;
  const double middle_s = 0.5 * camera.shutter.line_delay_s * camera.shutter.lines(camera.resolution_px);
  std::vector<Matrix3d> lies;
  for (std::size_t i = 0; i < T_t_c.size(); ++i) {
    lies.push_back(T_t_c.value[i].R * turning->R_w_c(T_t_c.time[i], middle_s).transpose());
  }
  const Matrix3d R_t_w = middle_of(lies);
  RollingPoses result;
  result.correlation = turning->correlation;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < features.size(); ++f) {
    Matrix3d H = Matrix3d::Zero();
    Vector3d g = Vector3d::Zero();
    std::vector<std::pair<Vector2d, Pose>> seen;  // pixel; attitude of its line, and the point in the place of p
    for (const Feature& feature : features.value[f]) {
      const auto point = target.find(feature.id);
      const auto bearing_c = camera.lens.unproject(feature.px);
      if (point == target.end() || !bearing_c) continue;
      const double line_s = camera.shutter.line_delay_s * camera.shutter.line(feature.px, camera.resolution_px);
      const Matrix3d R_t_c = R_t_w * turning->R_w_c(features.time[f], line_s);
      const Matrix3d across = hat(*bearing_c) * R_t_c.transpose();
      H += across.transpose() * across;
      g += across.transpose() * across * point->second;
      seen.push_back({feature.px, {R_t_c, point->second}});
    }
    if (seen.size() < kFewestPoints) continue;
    const Vector3d p_t_c = H.ldlt().solve(g);
    double own = 0.0;
    bool in_front = p_t_c.allFinite();
    for (const auto& [px, line] : seen) {
      const auto image = camera.lens.project(line.R.transpose() * (line.p - p_t_c));
      in_front = in_front && image.has_value();
      if (image) own += (*image - px).squaredNorm();
    }
    if (!in_front || own > kMostRms_px * kMostRms_px * 2.0 * static_cast<double>(seen.size())) continue;
    squares += own;
    count += 2 * seen.size();
    result.T_t_c.push_back(features.time[f] + from_seconds(middle_s),
                           {R_t_w * turning->R_w_c(features.time[f], middle_s), p_t_c});
  }
  result.rms_px = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(count, 1)));
  return result;
}

}  // namespace vispline
