/// Inputs of the command line's tests: what the program simulated, moved by a known amount.
#pragma once

#include <cmath>

#include "program.h"
#include "vispline/core/so3.h"
#include "vispline/io/write.h"

namespace vispline {

inline const Vector3d kRotation_second_first(0.02, -0.31, 0.2);  ///< rotation vector, rad
constexpr double kOffset_s = 0.012345;                           ///< of the second recording against the first

/// first.csv: the dance at 200 Hz with noise. second.csv: the same at 100 Hz with other noise, turned and late.
inline void make_imu_pair(const Program& program) {
  ASSERT_EQ(program.run("simulate --trajectory dance --noise course --seed 3 --out first.csv").exit, 0);
  ASSERT_EQ(program.run("simulate --trajectory dance --imu-rate 100 --noise course --seed 4 --out raw.csv").exit, 0);
  ImuSignal second = read_imu(program.path("raw.csv")).value;
  const Matrix3d R = SO3::exp<double>(kRotation_second_first);
  for (std::size_t i = 0; i < second.size(); ++i) {
    second.time[i] += from_seconds(kOffset_s);
    second.value[i] = {R * second.value[i].gyro, R * second.value[i].accel};
  }
  write_imu_csv(program.path("second.csv"), second);
}

/// truth.csv: the dance at 200 Hz (EuRoC). estimate.tum: every third pose, in another world, with smooth errors.
inline void make_trajectory_pair(const Program& program) {
  ASSERT_EQ(program.run("simulate --trajectory dance --out imu.csv --truth truth.csv").exit, 0);
  const Signal<Pose> truth = read_trajectory(program.path("truth.csv")).value;
  const Pose T_e_w{SO3::exp<double>(Vector3d(0.4, -0.7, 1.1)), Vector3d(3, -2, 0.5)};
  Signal<Pose> estimate;
  for (std::size_t i = 0; i < truth.size(); i += 3) {
    const double t = to_seconds(truth.time[i] - truth.time[0]);
    const Pose drift{SO3::exp<double>(Vector3d(1e-2 * std::sin(0.3 * t), 5e-3 * std::cos(t), 1e-3 * t)),
                     Vector3d(0.02 * std::sin(0.5 * t), 0.01 * std::cos(0.9 * t), 1e-4 * t * t)};
    estimate.push_back(truth.time[i], T_e_w * truth.value[i] * drift);
  }
  write_trajectory_tum(program.path("estimate.tum"), estimate);
}

}  // namespace vispline
