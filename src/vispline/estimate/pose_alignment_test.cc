// The first stage of a calibration: what it finds on good data, and what it calls bad data.
#include "vispline/estimate/pose_alignment.h"

#include <gtest/gtest.h>

#include "vispline/estimate/simulated_testing.h"

namespace vispline {
namespace {

using testing::Simulated;

const Pose kT_b_s{SO3::exp<double>(Vector3d(1.9, 0.4, -0.7)), Vector3d(0.02, 0.01, -0.03)};
constexpr double kOffset_s = 0.0123;

struct Good {
  ImuSignal imu;
  Signal<Pose> poses;
};

Good good(std::uint64_t seed = 1) {
  const Simulated data({.duration_s = 8.0, .seed = seed});
  return {data.imu(), data.poses(kT_b_s, kOffset_s, 60.0, 7.5)};
}

template <class Change>
Good changed(const Change& change) {
  Good data = good();
  for (ImuSample& s : data.imu.value) change(s);
  return data;
}

std::string verdict(const Good& data) {
  Diagnostics diagnostics;
  try {
    align_poses(data.poses, data.imu, diagnostics);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUnfit);
    EXPECT_FALSE(error.diagnostic().next.empty());
    return error.diagnostic().code + ": " + error.diagnostic().message;
  }
  return "none";
}

void expect_verdict(const Good& data, const std::string& code, const std::string& word) {
  const std::string found = verdict(data);
  EXPECT_EQ(found.substr(0, code.size()), code) << found;
  EXPECT_NE(found.find(word), std::string::npos) << found;
}

TEST(PoseAlignment, FindsClockRotationBiasAndGravity) {
  const Good data = good();
  Diagnostics diagnostics;
  const PoseAlignment found = align_poses(data.poses, data.imu, diagnostics);
  EXPECT_NEAR(found.time_offset_s, kOffset_s, 5e-4);
  EXPECT_GT(found.correlation, 0.99);
  EXPECT_LT(SO3::log<double>(Matrix3d(found.R_b_s.transpose() * kT_b_s.R)).norm(), 3e-3);
  EXPECT_LT((found.gyro_bias - Vector3d(0.01, -0.02, 0.015)).norm(), 2e-3);
  EXPECT_LT((found.g_w - Vector3d(0.0, 0.0, -testing::kGravity)).norm(), 0.5);  // with bias and lever arm in it
  EXPECT_LT(found.gyro_residual, 0.02);
}

TEST(PoseAlignment, DegreesPerSecond) {
  expect_verdict(changed([](ImuSample& s) { s.gyro *= 57.2957795; }), "E-UNITS", "deg/s");
}

TEST(PoseAlignment, ForceInG) {
  expect_verdict(changed([](ImuSample& s) { s.accel /= 9.80665; }), "E-UNITS", "looks like g");
}

TEST(PoseAlignment, GravityRemoved) {
  const Simulated data({.duration_s = 8.0});
  Good without = good();
  for (std::size_t i = 0; i < without.imu.size(); ++i) {
    const Matrix3d R_b_w = data.T_w_b.at(without.imu.time[i])->R_w_b.transpose();
    without.imu.value[i].accel -= R_b_w * Vector3d(0.0, 0.0, testing::kGravity);
  }
  expect_verdict(without, "E-UNITS", "no gravity");
}

TEST(PoseAlignment, OtherRecording) {
  Good data = good();
  const Trajectory other = analytic_trajectory("figure-eight", Time{}, from_seconds(20.0)).value();
  for (std::size_t i = 0; i < data.imu.size(); ++i) {
    data.imu.value[i].gyro = 3.0 * other.at(data.imu.time[i])->omega_b;
  }
  expect_verdict(data, "E-CLOCK", "no offset");
}

TEST(PoseAlignment, NoTurning) {
  expect_verdict(changed([](ImuSample& s) { s.gyro *= 0.01; }), "E-EXCITATION", "rad/s only");
}

TEST(PoseAlignment, TurningAboutOneAxis) {
  const Simulated data({.duration_s = 8.0});
  Good one = good();
  const auto yaw = [](Time t) {
    return std::sin(2.3 * to_seconds(t - Time{})) + 0.4 * std::sin(5.1 * to_seconds(t - Time{}));
  };
  for (std::size_t i = 0; i < one.poses.size(); ++i) {
    one.poses.value[i] = {SO3::exp<double>(Vector3d(0.0, 0.0, yaw(one.poses.time[i]))), Vector3d::Zero()};
  }
  for (std::size_t i = 0; i < one.imu.size(); ++i) {
    const Duration h = std::chrono::milliseconds(1);
    const double rate = (yaw(one.imu.time[i] + h) - yaw(one.imu.time[i] - h)) / 2e-3;
    one.imu.value[i] = {Vector3d(0.0, 0.0, rate), Vector3d(0.0, 0.0, testing::kGravity)};
  }
  expect_verdict(one, "E-EXCITATION", "one axis");
}

TEST(PoseAlignment, MirroredGyroscope) {
  expect_verdict(changed([](ImuSample& s) { s.gyro.x() = -s.gyro.x(); }), "E-AXES", "gyroscope");
}

TEST(PoseAlignment, AccelerometerWithOtherAxes) {
  expect_verdict(changed([](ImuSample& s) { std::swap(s.accel.x(), s.accel.z()); }), "E-AXES", "accelerometer");
}

TEST(PoseAlignment, NoTimeInCommon) {
  Good data = good();
  for (Time& t : data.poses.time) t += std::chrono::hours(1);
  EXPECT_NE(verdict(data), "none");
}

}  // namespace
}  // namespace vispline
