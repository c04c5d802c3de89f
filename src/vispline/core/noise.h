/// Noise of one triad (gyroscope or accelerometer), in continuous time. docs/math/noise.md.
#pragma once

namespace vispline {

/// All zero by default: an exact instrument. `unit` is rad/s for a gyroscope, m/s^2 for an accelerometer.
struct NoiseModel {
  double white = 0.0;             ///< N, white-noise density, unit/sqrt(Hz)
  double walk = 0.0;              ///< K, bias random walk, unit/s/sqrt(Hz)
  double bias_instability = 0.0;  ///< B, flicker coefficient, unit; the Allan floor is 0.664 B
  double turn_on_bias = 0.0;      ///< standard deviation of the bias at the first sample, unit
  double quantum = 0.0;           ///< least significant bit, unit; 0: none
  double range = 0.0;             ///< saturation at +-range, unit; 0: none
};

/// The accelerometer and gyroscope of one IMU.
struct ImuNoise {
  NoiseModel gyro;
  NoiseModel accel;
};

}  // namespace vispline
