/// sensor_msgs/Imu -> a reading with its stamp.
#pragma once

#include "vispline/bags/ros_messages.h"
#include "vispline/io/imu_checks.h"
#include "vispline/io/read_context.h"

namespace vispline {

/// Factors to SI of the flags --gyro-unit and --accel-unit; 1 without them, as ROS demands rad/s and m/s^2.
struct ImuFactors {
  double gyro = 1.0, accel = 1.0;
};

/// Throws E-ARGUMENT (exit 2) for unknown units.
ImuFactors imu_factors(const ReadOptions& options);

ImuSample imu_sample(const ros::Imu& message, const ImuFactors& factors);

/// A triad that is all zero, and whose covariance begins with -1, is not measured.
ImuAxes measured_axes(const ros::Imu& message);

}  // namespace vispline
