#include "vispline/estimate/gyro_rotation.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "vispline/core/so3.h"

namespace vispline {

GyroRotation::GyroRotation(const ImuSignal& imu, const Vector3d& gyro_bias, double level_s) : time_(imu.time) {
  R_w_b_.push_back(Matrix3d::Identity());
  Vector3d up_0 = Vector3d::Zero();
  for (std::size_t i = 0; i < imu.size(); ++i) {
    if (i > 0) {
      const Vector3d omega = 0.5 * (imu.value[i - 1].gyro + imu.value[i].gyro) - gyro_bias;
      R_w_b_.push_back(R_w_b_.back() * SO3::exp<double>(Vector3d(omega * to_seconds(imu.time[i] - imu.time[i - 1]))));
    }
    if (to_seconds(imu.time[i] - imu.time[0]) <= level_s) up_0 += R_w_b_.back() * imu.value[i].accel;
  }
  const Matrix3d level = Eigen::Quaterniond::FromTwoVectors(up_0, Vector3d::UnitZ()).toRotationMatrix();
  for (Matrix3d& R : R_w_b_) R = level * R;
}

Matrix3d GyroRotation::operator()(Time time) const {
  const auto after = std::upper_bound(time_.begin(), time_.end(), time);
  if (after == time_.begin()) return R_w_b_.front();
  if (after == time_.end()) return R_w_b_.back();
  const auto i = static_cast<std::size_t>(after - time_.begin());
  const double u = to_seconds(time - time_[i - 1]) / to_seconds(time_[i] - time_[i - 1]);
  const Vector3d turn = SO3::log<double>(Matrix3d(R_w_b_[i - 1].transpose() * R_w_b_[i]));
  return R_w_b_[i - 1] * SO3::exp<double>(Vector3d(u * turn));
}

}  // namespace vispline
