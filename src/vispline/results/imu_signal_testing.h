/// Synthetic IMU signals for tests: a motion known at every time, seen by two instruments. Not installed.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "vispline/core/random.h"
#include "vispline/core/so3.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Angular rate and specific force as sums of sines of 0.3 to 4 Hz with random amplitudes and phases: they never
/// repeat.
class TestMotion {
 public:
  explicit TestMotion(std::uint64_t seed) : random_(seed, "motion") {}

  ImuSample operator()(double t) const {
    ImuSample sample;
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro(axis) = sum(t, axis, 0.5);
      sample.accel(axis) = sum(t, axis + 3, 2.0) + (axis == 2 ? 9.81 : 0.0);
    }
    return sample;
  }

 private:
  double sum(double t, int channel, double amplitude) const {
    constexpr int kTerms = 6;
    double value = 0.0;
    for (int k = 0; k < kTerms; ++k) {
      const auto [u, v] = random_.uniform_pair(static_cast<std::uint64_t>(100 * channel + k));
      const double frequency_hz = 0.3 + 3.7 * (k + u) / kTerms;
      value += amplitude * std::sin(2.0 * std::numbers::pi * (frequency_hz * t + v));
    }
    return value / std::sqrt(kTerms / 2.0);
  }
  RandomStream random_;
};

/// How an instrument sees the motion: clock, frame, errors.
struct TestInstrument {
  double rate_hz = 200.0;
  double begin_s = 0.0, end_s = 20.0;  ///< on its own clock
  double clock_s = 0.0;                ///< true time = stamp + clock_s
  Matrix3d R_i_b = Matrix3d::Identity();
  Vector3d gyro_bias = Vector3d::Zero();   ///< rad/s, frame i
  Vector3d accel_bias = Vector3d::Zero();  ///< m/s^2, frame i
  double gyro_sigma = 0.0, accel_sigma = 0.0;
  std::uint64_t seed = 1;  ///< of its noise
};

template <class Motion>
ImuSignal observe(const Motion& motion, const TestInstrument& instrument) {
  const RandomStream random(instrument.seed, "noise");
  ImuSignal imu;
  const double duration_s = instrument.end_s - instrument.begin_s;
  const auto n = static_cast<std::uint64_t>(duration_s * instrument.rate_hz + 0.5);
  for (std::uint64_t i = 0; i < n; ++i) {
    const double stamp = instrument.begin_s + static_cast<double>(i) / instrument.rate_hz;
    const ImuSample truth = motion(stamp + instrument.clock_s);
    const auto noise = [&](std::uint64_t k) {
      return Vector3d(random.normal(6 * i + k), random.normal(6 * i + k + 1), random.normal(6 * i + k + 2));
    };
    imu.push_back(Time(from_seconds(stamp)),
                  {instrument.R_i_b * truth.gyro + instrument.gyro_bias + instrument.gyro_sigma * noise(0),
                   instrument.R_i_b * truth.accel + instrument.accel_bias + instrument.accel_sigma * noise(3)});
  }
  return imu;
}

/// The signal without the samples in (begin_s, end_s).
inline ImuSignal with_gap(const ImuSignal& imu, double begin_s, double end_s) {
  ImuSignal kept;
  for (std::size_t i = 0; i < imu.size(); ++i) {
    const double seconds = to_seconds(imu.time[i] - Time{});
    if (seconds <= begin_s || seconds >= end_s) kept.push_back(imu.time[i], imu.value[i]);
  }
  return kept;
}

/// The signal without a tenth of its samples, at random.
inline ImuSignal with_losses(const ImuSignal& imu, std::uint64_t seed) {
  const RandomStream random(seed, "losses");
  ImuSignal kept;
  for (std::size_t i = 0; i < imu.size(); ++i) {
    if (random.uniform_pair(i)[0] > 0.1) kept.push_back(imu.time[i], imu.value[i]);
  }
  return kept;
}

}  // namespace vispline
