#include "vispline/io/imu_message.h"

#include <algorithm>

#include "vispline/io/column_plan.h"

namespace vispline {
namespace {

bool is_absent(const ros::Vector3& v, const double (&covariance)[9]) {
  return covariance[0] == -1.0 && v.x == 0.0 && v.y == 0.0 && v.z == 0.0;
}

}  // namespace

ImuFactors imu_factors(const ReadOptions& options) {
  ColumnPlan units;
  apply_unit_flags(options, units);
  return {.gyro = units.gyro_unit.value_or(1.0), .accel = units.accel_unit.value_or(1.0)};
}

ImuSample imu_sample(const ros::Imu& message, const ImuFactors& factors) {
  const ros::Vector3 &w = message.angular_velocity, &f = message.linear_acceleration;
  return {factors.gyro * Vector3d(w.x, w.y, w.z), factors.accel * Vector3d(f.x, f.y, f.z)};
}

ImuAxes measured_axes(const ros::Imu& message) {
  ImuAxes axes;
  const auto leave_out = [&axes](std::size_t first) { std::fill_n(axes.present.begin() + first, 3, false); };
  if (is_absent(message.angular_velocity, message.angular_velocity_covariance)) leave_out(0);
  if (is_absent(message.linear_acceleration, message.linear_acceleration_covariance)) leave_out(3);
  return axes;
}

}  // namespace vispline
