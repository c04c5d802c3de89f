/// Is it an IMU, in rad/s and m/s^2? Warnings about units and dead axes from one look at each sample; single spikes are
/// found among their neighbours.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "vispline/io/even_sample.h"
#include "vispline/io/read_context.h"
#include "vispline/sensors/recording.h"

namespace vispline {

inline constexpr std::size_t kImuAxes = 6;

/// Gyroscope x y z, accelerometer x y z: is the axis in the file? A gyroscope or an accelerometer may stand alone.
struct ImuAxes {
  std::array<bool, kImuAxes> present{true, true, true, true, true, true};

  bool has_gyro() const { return present[0] || present[1] || present[2]; }
  bool has_accel() const { return present[3] || present[4] || present[5]; }
  bool whole_gyro() const { return present[0] && present[1] && present[2]; }
  bool whole_accel() const { return present[3] && present[4] && present[5]; }
};

inline double axis_value(const ImuSample& sample, std::size_t axis) {
  return axis < 3 ? sample.gyro[static_cast<Eigen::Index>(axis)] : sample.accel[static_cast<Eigen::Index>(axis - 3)];
}

/// Increasing indices of samples, from 1 to size - 2, that stand far off while their neighbours agree: by at least
/// 10 rad/s or 50 m/s^2 and 20 times the usual. None if they are more than 0.1 % (or one) of the samples.
std::vector<std::size_t> find_spikes(std::span<const ImuSample> samples, const ImuAxes& axes);

/// Sees each kept sample once.
class ImuCheck {
 public:
  ImuCheck(ReadContext& context, const ImuAxes& axes) : context_(context), axes_(axes) {}

  void add(std::span<const ImuSample> samples);

  /// After the last sample: W-UNITS, W-CONSTANT, W-SATURATED; throws E-CONSTANT (exit 4) if every axis is constant.
  /// Nothing for fewer than ten samples.
  void judge();

 private:
  /// How often an axis stays at its extreme, in runs of three samples or more.
  struct Extreme {
    double value = 0.0;
    std::int64_t run = 0, stuck = 0;
    void add(double v, bool beyond);
  };
  struct Axis {
    Extreme low, high;
    double first = 0.0, last = 0.0;
    double smallest_change = INFINITY;  ///< between neighbours that differ: at least one least significant bit
  };

  void add_axis(Axis& axis, std::span<const double> values) const;
  void judge_constant();
  void judge_units();
  void judge_saturation();

  ReadContext& context_;
  ImuAxes axes_;
  std::int64_t count_ = 0;
  std::array<Axis, kImuAxes> axis_;
  EvenSample<double> gyro_norm_, accel_norm_;
  std::vector<double> values_;
};

}  // namespace vispline
