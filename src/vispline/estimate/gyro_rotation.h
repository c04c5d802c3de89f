/// How the body turns by its gyroscope alone. docs/math/estimate.md, Start values.
#pragma once

#include <vector>

#include "vispline/sensors/recording.h"

namespace vispline {

/// R_w_b at the samples of an IMU, z up at the first of them on average over `level_s`; geodesics between samples.
class GyroRotation {
 public:
  /// Precondition: at least two samples.
  GyroRotation(const ImuSignal& imu, const Vector3d& gyro_bias, double level_s = 0.3);
  /// The first or last rotation beyond the samples.
  Matrix3d operator()(Time time) const;

 private:
  std::vector<Time> time_;
  std::vector<Matrix3d> R_w_b_;
};

}  // namespace vispline
