// The spacing of knots for motions of one frequency, against a spline that is really fitted.
#include "vispline/estimate/knot_spacing.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "vispline/core/random.h"
#include "vispline/core/rn.h"
#include "vispline/trajectory/spline.h"

namespace vispline {
namespace {

constexpr double kRate_hz = 200.0;
constexpr int kSamples = 4096;

/// Rate and force swing about all axes; white noise on top.
ImuSignal swinging(double frequency_hz, double gyro, double accel, double gyro_noise, double accel_noise) {
  const RandomStream stream(9, "imu");
  ImuSignal imu;
  for (int i = 0; i < kSamples; ++i) {
    const double t = i / kRate_hz, phase = 2.0 * std::numbers::pi * frequency_hz * t;
    const auto z = [&](std::uint64_t k) { return stream.normal(6 * static_cast<std::uint64_t>(i) + k); };
    const Vector3d swing(std::sin(phase), std::sin(phase + 1.0), std::sin(phase + 2.0));
    imu.push_back(Time{} + from_seconds(t), {gyro * swing + gyro_noise * Vector3d(z(0), z(1), z(2)),
                                             accel * swing + accel_noise * Vector3d(z(3), z(4), z(5))});
  }
  return imu;
}

/// What a spline of order K leaves of a swing of amplitude 1 about rms, by least squares over many knots.
template <int K>
double left_by_fit(double frequency_hz, double spacing_s) {
  using Line = Spline<Rn<1>, K>;
  using Number = Eigen::Matrix<double, 1, 1>;
  const double duration_s = 40.0 * spacing_s;
  const std::size_t count = Line::knots_for(from_seconds(duration_s), from_seconds(spacing_s));
  constexpr int kRows = 800;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kRows, static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<Number> unit(count, Number::Zero());
    unit[k](0) = 1.0;
    const Line line(Time{}, from_seconds(spacing_s), unit);
    for (int i = 0; i < kRows; ++i) {
      A(i, static_cast<Eigen::Index>(k)) = line.element(Time{} + from_seconds(duration_s * i / kRows))(0);
    }
  }
  Eigen::VectorXd y(kRows);
  for (int i = 0; i < kRows; ++i) y(i) = std::sin(2.0 * std::numbers::pi * frequency_hz * duration_s * i / kRows);
  const Eigen::VectorXd rest = y - A * A.householderQr().solve(y);
  return rest.segment(kRows / 4, kRows / 2).norm() / std::sqrt(kRows / 2.0);
}

/// The spacing that is chosen leaves what is predicted. A rate is a spline of one order less than the curve, a specific
/// force of two orders less.
TEST(KnotSpacing, LossIsThatOfAFittedSpline) {
  for (const double frequency_hz : {1.5, 3.0}) {
    const KnotSpacingChoice choice = choose_knot_spacing(swinging(frequency_hz, 1.0, 1.0, 1e-3, 2e-3), 5, 8.0);
    const double gyro = left_by_fit<4>(frequency_hz, choice.spacing_s);
    const double accel = left_by_fit<3>(frequency_hz, choice.spacing_s);
    EXPECT_NEAR(choice.gyro_loss / gyro, 1.0, 0.2) << frequency_hz << " Hz at " << choice.spacing_s << " s";
    EXPECT_NEAR(choice.accel_loss / accel, 1.0, 0.2) << frequency_hz << " Hz at " << choice.spacing_s << " s";
  }
}

TEST(KnotSpacing, NoiseIsThatOfTheTopOfTheBand) {
  const KnotSpacingChoice choice = choose_knot_spacing(swinging(1.0, 1.0, 2.0, 0.01, 0.05));
  EXPECT_NEAR(choice.gyro_noise, 0.01, 0.0015);
  EXPECT_NEAR(choice.accel_noise, 0.05, 0.0075);
  EXPECT_LT(choice.gyro_loss, 0.35 * choice.gyro_noise);
  EXPECT_LT(choice.accel_loss, 0.35 * choice.accel_noise);
  EXPECT_NE(choice.why.find("knots every"), std::string::npos);
}

TEST(KnotSpacing, FasterMotionNeedsCloserKnots) {
  double before = 1.0;
  for (const double frequency_hz : {0.5, 2.0, 5.0}) {
    const double spacing_s = choose_knot_spacing(swinging(frequency_hz, 1.0, 1.0, 0.01, 0.05)).spacing_s;
    EXPECT_LT(spacing_s, before) << frequency_hz;
    before = spacing_s;
  }
  EXPECT_EQ(choose_knot_spacing(swinging(1.0, 0.0, 0.0, 0.01, 0.05)).spacing_s, 0.2);
}

TEST(KnotSpacing, ShortRecordsSaySo) {
  ImuSignal imu = swinging(1.0, 1.0, 1.0, 0.01, 0.05);
  imu.time.resize(20);
  imu.value.resize(20);
  EXPECT_NE(choose_knot_spacing(imu).why.find("too few"), std::string::npos);
}

}  // namespace
}  // namespace vispline
