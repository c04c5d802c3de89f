/// Gyroscope and accelerometer over one stretch of samples. docs/math/estimate.md, Inertial rows; docs/math/imu.md.
#pragma once

#include <memory>
#include <span>

#include "vispline/estimate/measurement.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Standard deviations of one reading, per axis.
struct ImuSigma {
  double gyro = 0.0;   ///< rad/s
  double accel = 0.0;  ///< m/s^2; 0: the accelerometer is not used
};

struct ImuBatch {
  std::size_t imu = 0;  ///< of the rig
  std::span<const Time> time{};
  std::span<const ImuSample> sample{};
  ImuSigma sigma{};
  Huber loss{};  ///< of each triad
};

std::unique_ptr<Measurement> imu_measurement(const State& state, const ImuBatch& batch);

}  // namespace vispline
