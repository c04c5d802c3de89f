#include "vispline/results/imu_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "vispline/results/imu_signal_testing.h"

namespace vispline {
namespace {

constexpr double kRightAngle = 0.5 * std::numbers::pi;
const Vector3d kTurn(0.9, -0.4, 1.7);

/// The second instrument defines clock and frame. Offset and rotation are those that compare_imu should report.
TestInstrument first_instrument(double offset_s, const Vector3d& rotation_vector) {
  TestInstrument instrument;
  instrument.clock_s = offset_s;
  instrument.R_i_b = SO3::exp<double>(rotation_vector).transpose();
  return instrument;
}

double worst_rms(const std::array<AxisComparison, 3>& axes) {
  return std::max({axes[0].rms, axes[1].rms, axes[2].rms});
}

bool warns(const ImuComparison& c, const std::string& code) { return c.diagnostics.counts().contains(code); }

std::string error_code(const ImuSignal& first, const ImuSignal& second, const ImuCompareOptions& options = {}) {
  try {
    compare_imu(first, second, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUnfit);
    return error.diagnostic().code;
  }
  return "";
}

class KnownOffset : public testing::TestWithParam<double> {};

TEST_P(KnownOffset, IsRecoveredWithoutNoise) {
  const double offset_s = GetParam();
  const TestMotion motion(11);
  TestInstrument first = first_instrument(offset_s, kTurn);
  first.rate_hz = 230.0;
  const ImuComparison c = compare_imu(observe(motion, first), observe(motion, {}));
  EXPECT_TRUE(c.aligned);
  EXPECT_NEAR(c.time_offset_s, offset_s, 2e-9);
  EXPECT_LT((c.R_second_first - SO3::exp<double>(kTurn)).norm(), 1e-7);
  EXPECT_LT((c.rotation_vector - kTurn).norm(), 1e-7);
  EXPECT_LT(worst_rms(c.gyroscope), 1e-5);
  EXPECT_LT(worst_rms(c.accelerometer), 1e-4);
  for (const AxisComparison& axis : c.accelerometer) EXPECT_GT(*axis.correlation, 0.999999);
  EXPECT_EQ(c.compared + c.outside + c.in_gaps, 4000);
  EXPECT_GT(c.offset_confidence, 0.3);
  EXPECT_FALSE(warns(c, "W-CONVERGENCE") || warns(c, "W-AMBIGUOUS") || warns(c, "W-EXCITATION"));
}

INSTANTIATE_TEST_SUITE_P(SubSampleToSeconds, KnownOffset,
                         testing::Values(0.0, 1e-5, -0.0013, 0.0025, 0.0317, -0.25, 1.23456, -4.321, 7.9, -8.765));

class NoisyPair : public testing::TestWithParam<std::uint64_t> {};

/// Both signals noisy, both with gaps and losses, other rates, a frame turned by 90 degrees, constant biases.
TEST_P(NoisyPair, OffsetRotationBiasAndNoiseAreRecovered) {
  const std::uint64_t seed = GetParam();
  const TestMotion motion(seed);
  const Vector3d turn = kRightAngle * Vector3d::Unit(static_cast<Eigen::Index>(seed % 3));
  const double offset_s = 0.7 * std::sin(static_cast<double>(seed)) + 1.3e-3;
  TestInstrument first = first_instrument(offset_s, turn);
  first.rate_hz = 181.0;
  first.end_s = 60.0;
  first.gyro_sigma = 0.01;
  first.accel_sigma = 0.05;
  first.seed = 2 * seed;
  TestInstrument second{
      .end_s = 60.0, .gyro_bias = Vector3d(0.05, -0.03, 0.02), .accel_bias = Vector3d(0.2, 0.1, -0.3)};
  second.gyro_sigma = 0.02;
  second.accel_sigma = 0.1;
  second.seed = 2 * seed + 1;
  const ImuSignal a = with_losses(with_gap(with_gap(observe(motion, first), 10.0, 13.0), 30.0, 30.2), seed);
  const ImuSignal b = with_losses(with_gap(observe(motion, second), 40.0, 42.0), seed + 100);
  const ImuComparison c = compare_imu(a, b);
  EXPECT_NEAR(c.time_offset_s, offset_s, 1e-4);
  EXPECT_LT(SO3::log<double>(c.R_second_first * SO3::exp<double>(turn).transpose()).norm(), 1.5e-3);
  EXPECT_EQ(c.compared + c.outside + c.in_gaps, static_cast<std::int64_t>(b.size()));
  EXPECT_NEAR(static_cast<double>(c.in_gaps), 3.2 * 200.0 * 0.9, 40.0);
  for (int axis = 0; axis < 3; ++axis) {
    const AxisComparison& gyro = c.gyroscope[static_cast<std::size_t>(axis)];
    const AxisComparison& accel = c.accelerometer[static_cast<std::size_t>(axis)];
    EXPECT_NEAR(gyro.mean, second.gyro_bias(axis), 2e-3);
    EXPECT_NEAR(accel.mean, second.accel_bias(axis), 2e-2);
    EXPECT_GT(gyro.std, 0.02);  // of the second, plus what the interpolation leaves of the first
    EXPECT_LT(gyro.std, std::hypot(0.02, 0.012));
    EXPECT_GT(accel.std, 0.1);
    EXPECT_LT(accel.std, std::hypot(0.1, 0.06));
    EXPECT_NEAR(gyro.rms, std::hypot(gyro.mean, gyro.std), 1e-15);
    EXPECT_GT(*gyro.correlation, 0.99);
  }
  EXPECT_TRUE(warns(c, "W-UNPAIRED"));
}

INSTANTIATE_TEST_SUITE_P(Seeds, NoisyPair, testing::Range<std::uint64_t>(1, 9));

/// Interpolation smooths noise between samples, which must not pull the offset there: the error shrinks with length.
TEST(ImuComparison, NoiseDoesNotBiasTheOffset) {
  double sum = 0.0, largest = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const TestMotion motion(seed);
    TestInstrument first = first_instrument(0.00125, Vector3d::Zero());  // a quarter of a sample: the steepest place
    first.gyro_sigma = 0.03;
    first.end_s = 40.0;
    first.seed = 500 + seed;
    const TestInstrument second{.end_s = 40.0, .gyro_sigma = 0.03, .seed = 600 + seed};
    const double error = compare_imu(observe(motion, first), observe(motion, second)).time_offset_s - 0.00125;
    sum += error;
    largest = std::max(largest, std::abs(error));
  }
  EXPECT_LT(std::abs(sum / 8.0), 4e-5);
  EXPECT_LT(largest, 1.5e-4);
}

TEST(ImuComparison, SwappedFilesGiveTheInverse) {
  const TestMotion motion(21);
  const ImuSignal a = observe(motion, first_instrument(0.4321, kTurn)), b = observe(motion, {.rate_hz = 150.0});
  const ImuComparison ab = compare_imu(a, b), ba = compare_imu(b, a);
  EXPECT_NEAR(ab.time_offset_s, -ba.time_offset_s, 1e-6);
  EXPECT_LT((ab.R_second_first * ba.R_second_first - Matrix3d::Identity()).norm(), 1e-5);
}

TEST(ImuComparison, AlignedFirstSignalIsAtTheStampsOfTheSecond) {
  const TestMotion motion(22);
  const ImuSignal second = observe(motion, {.begin_s = 2.0, .end_s = 12.0});
  const ImuComparison c = compare_imu(observe(motion, first_instrument(-0.123, kTurn)), second);
  ASSERT_EQ(c.first_at_second.size(), second.size());
  EXPECT_EQ(c.first_at_second.time, second.time);
  EXPECT_LT((c.first_at_second.value[700].accel - second.value[700].accel).norm(), 1e-3);
}

TEST(ImuComparison, ClocksMayStartAnywhere) {
  const TestMotion motion(23);
  const ImuSignal first = observe(motion, {});
  ImuSignal second = observe(motion, {});
  const Duration shift = std::chrono::seconds(1'500'000'000) + std::chrono::microseconds(123);
  for (Time& time : second.time) time += shift;
  EXPECT_EQ(error_code(first, second), "E-OVERLAP");
  EXPECT_NEAR(compare_imu(first, second, {.max_offset_s = 2e9}).time_offset_s, to_seconds(shift), 1e-6);
  EXPECT_EQ(error_code(first, second, {.max_offset_s = 100.0}), "E-OVERLAP");
}

TEST(ImuComparison, OffsetsBeyondTheLimitAreNotLookedFor) {
  const TestMotion motion(24);
  const ImuSignal first = observe(motion, first_instrument(3.0, Vector3d::Zero())), second = observe(motion, {});
  EXPECT_NEAR(compare_imu(first, second, {.max_offset_s = 3.5}).time_offset_s, 3.0, 1e-6);
  const ImuComparison limited = compare_imu(first, second, {.max_offset_s = 1.0});
  EXPECT_LE(std::abs(limited.time_offset_s), 1.1);
}

TEST(ImuComparison, StaticSignalsAreComparedAsTheyAre) {
  const auto still = [](double) { return ImuSample{Vector3d::Zero(), Vector3d(0.0, 0.0, 9.81)}; };
  TestInstrument first{.gyro_sigma = 0.01, .accel_sigma = 0.1, .seed = 5};
  const TestInstrument second{.gyro_bias = Vector3d(0.1, 0.2, 0.3), .gyro_sigma = 0.01, .accel_sigma = 0.1, .seed = 6};
  const ImuComparison c = compare_imu(observe(still, first), observe(still, second));
  EXPECT_FALSE(c.aligned);
  EXPECT_EQ(c.time_offset_s, 0.0);
  EXPECT_EQ(c.R_second_first, Matrix3d::Identity());
  EXPECT_TRUE(warns(c, "W-EXCITATION"));
  EXPECT_NEAR(c.gyroscope[1].mean, 0.2, 1e-3);
  EXPECT_NEAR(c.accelerometer[2].std, 0.1 * std::numbers::sqrt2, 0.01);
  EXPECT_LT(std::abs(*c.accelerometer[2].correlation), 0.1);
}

TEST(ImuComparison, AxesWithoutVarianceHaveNoCorrelation) {
  const auto still = [](double) { return ImuSample{Vector3d(0.1, 0.0, 0.0), Vector3d(0.0, 0.0, 9.81)}; };
  const ImuComparison c = compare_imu(observe(still, {}), observe(still, {.accel_sigma = 0.1}));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_FALSE(c.gyroscope[axis].correlation);
    EXPECT_FALSE(c.accelerometer[axis].correlation);  // the first does not vary
    EXPECT_TRUE(std::isfinite(c.accelerometer[axis].rms));
  }
}

TEST(ImuComparison, OneAxisOfRotationLeavesTheRestAlone) {
  const TestMotion motion(25);
  const auto planar = [&](double t) {
    ImuSample sample = motion(t);
    sample.gyro.head<2>().setZero();
    return sample;
  };
  for (const double sigma : {0.0, 0.005}) {
    TestInstrument first = first_instrument(0.0333, Vector3d::Zero());
    first.gyro_sigma = sigma;
    const ImuComparison c = compare_imu(observe(planar, first), observe(planar, {.gyro_sigma = sigma, .seed = 9}));
    EXPECT_TRUE(c.aligned);
    EXPECT_TRUE(warns(c, "W-EXCITATION"));
    EXPECT_NEAR(c.time_offset_s, 0.0333, sigma == 0.0 ? 1e-7 : 2e-4);
    EXPECT_LT(c.rotation_vector.norm(), sigma == 0.0 ? 1e-9 : 1e-3);
  }
}

TEST(ImuComparison, RepeatedMotionIsCalledAmbiguous) {
  const TestMotion motion(26);
  const auto repeated = [&](double t) { return motion(t - 4.0 * std::floor(t / 4.0)); };
  const ImuComparison c = compare_imu(observe(repeated, {.end_s = 40.0}), observe(repeated, {.end_s = 40.0}));
  EXPECT_NEAR(c.time_offset_s, 0.0, 1e-7);
  EXPECT_LT(c.offset_confidence, 0.05);
  EXPECT_TRUE(warns(c, "W-AMBIGUOUS"));
}

TEST(ImuComparison, ShortOrForeignSignalsAreRefused) {
  const TestMotion motion(27);
  const ImuSignal good = observe(motion, {}), tiny = observe(motion, {.end_s = 0.04});
  EXPECT_EQ(error_code(good, tiny), "E-TOO-SHORT");
  EXPECT_EQ(error_code({}, good), "E-TOO-SHORT");
  EXPECT_EQ(error_code(good, observe(motion, {.begin_s = 20.5, .end_s = 30.0})), "E-OVERLAP");
  EXPECT_THROW(compare_imu(good, good, {.max_offset_s = -1.0}), Error);
}

TEST(ImuComparison, SameInputSameBytes) {
  const TestMotion motion(28);
  const ImuSignal a = observe(motion, first_instrument(0.3, kTurn)), b = observe(motion, {.gyro_sigma = 0.01});
  const ImuComparison one = compare_imu(a, b), two = compare_imu(a, b);
  EXPECT_EQ(one.time_offset_s, two.time_offset_s);
  EXPECT_EQ(one.R_second_first, two.R_second_first);
  EXPECT_EQ(one.gyroscope[0].rms, two.gyroscope[0].rms);
}

}  // namespace
}  // namespace vispline
