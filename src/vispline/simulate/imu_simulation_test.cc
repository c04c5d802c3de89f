#include "vispline/simulate/imu_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"
#include "vispline/simulate/rig_simulation.h"

namespace vispline {
namespace {

/// A body at rest and level.
struct StillCurve {
  TimeSpan span_;
  TimeSpan span() const { return span_; }
  BodyState at(Time) const { return {}; }
};

/// A state that depends on time in every member; x of the rate is the time itself, in seconds.
struct RampCurve {
  TimeSpan span_;
  TimeSpan span() const { return span_; }
  BodyState at(Time time) const {
    const double t = to_seconds(time.time_since_epoch());
    BodyState state;
    state.R_w_b = SO3::exp<double>(Vector3d(0.3 * t, 0.1, -0.2 * t));
    state.omega_b = Vector3d(t, std::sin(t), 0.5);
    state.a_w = Vector3d(std::cos(3.0 * t), 0.2 * t, -1.0);
    state.alpha_b = Vector3d(1.0, std::cos(t), 0.0);
    return state;
  }
};

constexpr Duration kSecond = std::chrono::seconds(1);
const TimeSpan kHour{time_from_ns(0), time_from_ns(0) + 3600 * kSecond};
const Trajectory kStill(StillCurve{kHour}), kRamp(RampCurve{kHour});

Stamps stamps_at(double rate_hz, Duration start, Duration duration) {
  return Stamps(SampleClock{time_from_ns(start.count()), rate_hz}, duration);
}

/// Every parameter and every kind of noise switched on.
ImuSimulation full_simulation() {
  ImuSimulation simulation;
  simulation.seed = 17;
  Imu& imu = simulation.imu;
  imu.gyroscope.T_b_i = {SO3::exp<double>(Vector3d(0.1, -0.4, 1.0)), Vector3d(0.1, 0.2, -0.3)};
  imu.gyroscope.g_sensitivity.setConstant(1e-3);
  imu.gyroscope.bias = Vector3d(0.01, 0.02, 0.03);
  imu.gyroscope.time_offset_s = 0.0021;
  imu.accelerometer.T_b_i = imu.gyroscope.T_b_i;
  imu.accelerometer.scale = Vector3d(0.01, -0.02, 0.03);
  imu.accelerometer.time_offset_s = -0.0013;
  imu.noise.gyro = {0.015, 1e-4, 1e-3, 0.02, 1e-4, 34.0};
  imu.noise.accel = {0.019, 1e-3, 1e-2, 0.1, 1e-3, 80.0};
  return simulation;
}

template <class Value>
bool same_bytes(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

void expect_same_bytes(const SimulatedImu& a, const SimulatedImu& b) {
  EXPECT_TRUE(same_bytes(a.measured.time, b.measured.time));
  EXPECT_TRUE(same_bytes(a.measured.value, b.measured.value));
  EXPECT_TRUE(same_bytes(a.exact, b.exact));
  EXPECT_TRUE(same_bytes(a.bias, b.bias));
  EXPECT_TRUE(same_bytes(a.body.time, b.body.time));
  EXPECT_TRUE(same_bytes(a.body.value, b.body.value));
}

TEST(SimulateImu, AtRestReadsPlusGExactly) {
  const SimulatedImu imu = simulate_imu(kStill, {}, stamps_at(200.0, kSecond, 20 * kSecond));
  ASSERT_EQ(imu.measured.size(), 4000u);
  EXPECT_EQ(imu.measured.time.front(), time_from_ns(1000000000));
  EXPECT_EQ(imu.measured.time.back(), time_from_ns(20995000000));
  for (const ImuSample& sample : imu.measured.value) {
    ASSERT_EQ(sample.gyro, Vector3d::Zero());
    ASSERT_EQ(sample.accel, Vector3d(0.0, 0.0, 9.81));
  }
}

TEST(SimulateImu, WithoutNoiseIsThePredictionBitForBit) {
  ImuSimulation simulation = full_simulation();
  simulation.imu.noise = {};
  const SimulatedImu imu = simulate_imu(kRamp, simulation, stamps_at(190.0, kSecond, 2 * kSecond));
  EXPECT_TRUE(same_bytes(imu.measured.value, imu.exact));
  const auto& [gyroscope, accelerometer] = std::tie(simulation.imu.gyroscope, simulation.imu.accelerometer);
  for (std::size_t i = 0; i < imu.exact.size(); ++i) {
    const Time stamp = imu.measured.time[i];
    ASSERT_EQ(imu.body.time[i], stamp + Duration(2100000));
    const BodyState at_gyro = kRamp.at(imu.body.time[i]).value(),
                    at_accel = kRamp.at(stamp - Duration(1300000)).value();
    ASSERT_EQ(imu.body.value[i].a_w, at_gyro.a_w);
    ASSERT_EQ(imu.exact[i].gyro, Gyroscope::predict(at_gyro, gyroscope, simulation.g_w));
    ASSERT_EQ(imu.exact[i].accel, Accelerometer::predict(at_accel, accelerometer, simulation.g_w));
    ASSERT_EQ(imu.bias[i].gyro, gyroscope.bias);
  }
}

TEST(SimulateImu, BodyTimeIsStampPlusTimeOffset) {
  ImuSimulation simulation;
  simulation.imu.gyroscope.time_offset_s = 0.25;  // the sensor's clock is late: at stamp 1 s the body is at 1.25 s
  const SimulatedImu imu = simulate_imu(kRamp, simulation, stamps_at(10.0, kSecond, kSecond));
  EXPECT_DOUBLE_EQ(imu.measured.value[0].gyro.x(), 1.25);
  EXPECT_DOUBLE_EQ(imu.measured.value[9].gyro.x(), 2.15);
}

TEST(SimulateImu, SameBytesForAnyThreadsAndBlocks) {
  ImuSimulation simulation = full_simulation();
  const Stamps stamps = stamps_at(190.0, kSecond, 60 * kSecond);  // 44 full chunks and a part
  const SimulatedImu one = simulate_imu(kRamp, simulation, stamps);
  ASSERT_EQ(one.measured.size(), 11400u);
  for (const std::size_t threads : {1, 2, 4}) {
    for (const std::size_t block_size : {100000, 5000, 77}) {
      simulation.threads = threads;
      simulation.block_size = block_size;
      expect_same_bytes(simulate_imu(kRamp, simulation, stamps), one);
    }
  }
  simulation.seed += 1;
  EXPECT_FALSE(same_bytes(simulate_imu(kRamp, simulation, stamps).measured.value, one.measured.value));
}

TEST(SimulateImu, StreamsInBlocksOfTheSizeAskedFor) {
  ImuSimulation simulation = full_simulation();
  simulation.block_size = 300;
  std::vector<std::size_t> sizes;
  const std::size_t outside = simulate_imu(kRamp, simulation, stamps_at(100.0, kSecond, 10 * kSecond),
                                           [&](const SimulatedImu& block) { sizes.push_back(block.measured.size()); });
  EXPECT_EQ(sizes, (std::vector<std::size_t>{300, 300, 300, 100}));
  EXPECT_EQ(outside, 0u);
}

TEST(SimulateImu, AListOfStampsReadsAsTheClockDoes) {
  const Stamps clock = stamps_at(125.0, kSecond, 20 * kSecond);
  std::vector<Time> list;
  for (std::size_t i = 0; i < clock.size(); ++i) list.push_back(clock[i]);
  const SimulatedImu a = simulate_imu(kRamp, full_simulation(), clock);
  const SimulatedImu b = simulate_imu(kRamp, full_simulation(), Stamps(list));
  EXPECT_TRUE(same_bytes(a.exact, b.exact));
  for (std::size_t i = 0; i < clock.size(); ++i) {
    ASSERT_LT((a.bias[i].gyro - b.bias[i].gyro).norm(), 1e-12);
    ASSERT_LT((a.bias[i].accel - b.bias[i].accel).norm(), 1e-12);
  }
}

TEST(SimulateImu, MeasuredIsExactPlusBiasPlusWhiteNoise) {
  ImuSimulation simulation = full_simulation();
  for (NoiseModel* noise : {&simulation.imu.noise.gyro, &simulation.imu.noise.accel})
    noise->quantum = noise->range = 0.0;
  const double rate_hz = 400.0;
  const SimulatedImu imu = simulate_imu(kRamp, simulation, stamps_at(rate_hz, kSecond, 100 * kSecond));
  Vector3d gyro = Vector3d::Zero(), accel = Vector3d::Zero();  // sums of squares
  const Vector3d& constant_bias = simulation.imu.gyroscope.bias;
  for (std::size_t i = 0; i < imu.exact.size(); ++i) {
    const ImuSample& sample = imu.measured.value[i];
    gyro += (sample.gyro - imu.exact[i].gyro - (imu.bias[i].gyro - constant_bias)).cwiseAbs2();
    accel += (sample.accel - imu.exact[i].accel - imu.bias[i].accel).cwiseAbs2();
  }
  const double n = static_cast<double>(imu.exact.size()), tolerance = 6.0 * std::sqrt(2.0 / n);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(gyro[axis] / n / (0.015 * 0.015 * rate_hz), 1.0, tolerance);
    EXPECT_NEAR(accel[axis] / n / (0.019 * 0.019 * rate_hz), 1.0, tolerance);
  }
}

TEST(SimulateImu, QuantisesAndSaturatesTheMeasurementOnly) {
  ImuSimulation simulation;
  simulation.imu.noise.accel = {.white = 1.0, .quantum = 0.5, .range = 12.0};
  const SimulatedImu imu = simulate_imu(kStill, simulation, stamps_at(100.0, kSecond, 10 * kSecond));
  bool saturated = false;
  for (std::size_t i = 0; i < imu.exact.size(); ++i) {
    ASSERT_EQ(imu.exact[i].accel.z(), 9.81);
    for (const double a : imu.measured.value[i].accel) {
      ASSERT_EQ(a, 0.5 * std::nearbyint(a / 0.5));
      ASSERT_LE(std::abs(a), 12.0);
    }
    saturated |= imu.measured.value[i].accel.z() == 12.0;  // sigma is 10 m/s^2
  }
  EXPECT_TRUE(saturated);
}

TEST(SimulateImu, StampsOutsideTheTrajectoryAreAnErrorOrCounted) {
  ImuSimulation simulation = full_simulation();
  simulation.imu.accelerometer.time_offset_s = -0.015;  // the first two stamps are before the trajectory begins
  const Stamps stamps = stamps_at(100.0, Duration(0), 3601 * kSecond);
  int calls = 0;
  try {
    simulate_imu(kRamp, simulation, stamps, [&](const SimulatedImu&) { ++calls; });
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostic().code, "E-SPAN");
    EXPECT_NE(error.diagnostic().message.find("102 of 360100"), std::string::npos) << error.what();
  }
  EXPECT_EQ(calls, 0);
  simulation.outside = OutsideSpan::kSkip;
  const SimulatedImu kept = simulate_imu(kRamp, simulation, stamps);
  EXPECT_EQ(kept.outside, 102u);  // 2 at the start, 1 s and the last 2.1 ms (gyroscope) at the end
  EXPECT_EQ(kept.measured.size(), 360100u - 102u);
  EXPECT_EQ(kept.measured.time.front(), time_from_ns(20000000));
  EXPECT_EQ(kept.measured.time.back(), time_from_ns(0) + 3600 * kSecond - Duration(10000000));
  EXPECT_THROW(simulate_imu(kRamp, simulation, stamps_at(100.0, 4000 * kSecond, kSecond)), Error);
}

TEST(SimulateImu, RefusesAWrongSimulation) {
  const Stamps stamps = stamps_at(100.0, kSecond, kSecond);
  ImuSimulation wrong_block, wrong_gravity, wrong_imu;
  wrong_block.block_size = 0;
  wrong_gravity.g_w.y() = NAN;
  wrong_imu.imu.noise.gyro.walk = -1.0;
  for (const ImuSimulation& simulation : {wrong_block, wrong_gravity, wrong_imu}) {
    EXPECT_THROW(simulate_imu(kStill, simulation, stamps), Error);
  }
}

TEST(SimulateRig, AnotherImuChangesNothingAndIsIndependent) {
  const Imu first = full_simulation().imu;
  Imu second = first;
  second.name = "imu1";
  const auto run = [](const Rig& rig) {
    return simulate(kStill, rig, time_from_ns(1000000000), 200 * kSecond, {.seed = 3, .threads = 2});
  };
  const Recording alone = run({{first}}), both = run({{second, first}});
  EXPECT_EQ(alone.imus.size(), 1u);
  EXPECT_TRUE(same_bytes(alone.imus.at("imu0").value, both.imus.at("imu0").value));
  const auto &a = both.imus.at("imu0").value, &b = both.imus.at("imu1").value;
  ASSERT_EQ(a.size(), 40000u);
  Vector3d product = Vector3d::Zero();  // of first differences, which are white up to a lag of one
  for (std::size_t i = 2; i < a.size(); i += 2) {
    product += (a[i].gyro - a[i - 1].gyro).cwiseProduct(b[i].gyro - b[i - 1].gyro);
  }
  const double variance = 2.0 * 0.015 * 0.015 * 200.0, n = static_cast<double>(a.size() / 2);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(product[axis] / n / variance), 6.0 / std::sqrt(n));
}

TEST(SimulateRig, EachImuHasItsOwnRate) {
  const Rig rig{{Imu{.name = "fast", .rate_hz = 1000.0}, Imu{.name = "slow", .rate_hz = 50.0}}};
  const Recording recording = simulate(kRamp, rig, time_from_ns(0), 2 * kSecond);
  EXPECT_EQ(recording.imus.at("fast").size(), 2000u);
  EXPECT_EQ(recording.imus.at("slow").size(), 100u);
}

}  // namespace
}  // namespace vispline
