/// Readings against numbers worked out by hand, the laws of the specific force, and what an IMU may be.
#include "vispline/sensors/imu.h"

#include <gtest/gtest.h>

#include <limits>

#include "vispline/core/error.h"
#include "vispline/sensors/jacobian_testing.h"
#include "vispline/sensors/rig.h"

namespace vispline {
namespace {

const Vector3d kGravity_w(0.0, 0.0, -9.81);

TEST(Accelerometer, AtRestWithZUpReadsPlusG) {
  EXPECT_EQ(Accelerometer::predict<double>({}, {}, kGravity_w), Vector3d(0.0, 0.0, 9.81));
  EXPECT_EQ(Gyroscope::predict<double>({}, {}, kGravity_w), Vector3d::Zero());
}

TEST(Accelerometer, FreeFallReadsZero) {
  BodyState state = testing::generic_point<Accelerometer>(1).state;
  state.omega_b.setZero();
  state.alpha_b.setZero();
  state.a_w = kGravity_w;
  Accelerometer::Params<double> params;
  params.T_b_i.p = Vector3d(0.3, -0.2, 0.7);
  EXPECT_EQ(Accelerometer::predict<double>(state, params, kGravity_w), Vector3d::Zero());
}

TEST(Accelerometer, LeverArmOnATurntable) {
  // 3 rad/s and 5 rad/s^2 about z, 0.2 m out on x: -omega^2 r = -1.8 towards the axis, alpha r = 1 along y.
  BodyState state;
  state.omega_b = Vector3d(0.0, 0.0, 3.0);
  state.alpha_b = Vector3d(0.0, 0.0, 5.0);
  Accelerometer::Params<double> params;
  params.T_b_i.p = Vector3d(0.2, 0.0, 0.0);
  const Vector3d f_b(-1.8, 1.0, 9.81);
  EXPECT_LT((Accelerometer::predict(state, params, kGravity_w) - f_b).norm(), 1e-14);
  // The same instrument turned by +90 degrees about z: its x axis points along y of the body.
  params.T_b_i.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_LT((Accelerometer::predict(state, params, kGravity_w) - Vector3d(1.0, 1.8, 9.81)).norm(), 1e-14);
}

TEST(Accelerometer, PitchedUpFeelsGravityAlongX) {
  // Nose up by 30 degrees (rotation about -y): x of the body points 30 degrees above the horizon.
  BodyState state;
  state.R_w_b = SO3::exp<double>(Vector3d(0.0, -std::numbers::pi / 6, 0.0));
  const Vector3d expected(9.81 * 0.5, 0.0, 9.81 * std::sqrt(3.0) / 2.0);
  EXPECT_LT((Accelerometer::predict<double>(state, {}, kGravity_w) - expected).norm(), 1e-14);
}

TEST(Accelerometer, ScaleMisalignmentAndBiasByHand) {
  Accelerometer::Params<double> params;
  params.scale = Vector3d(0.1, 0.2, -0.5);
  params.misalignment << 0.01, 0.02, 0.03, 0.04, 0.05, 0.06;
  params.bias = Vector3d(0.5, -0.5, 0.25);
  BodyState state;
  state.a_w = Vector3d(1.0, 2.0, 4.0 - 9.81);  // f = (1, 2, 4)
  // (1.1 + 0.02 + 0.08 + 0.5, 0.03 + 2.4 + 0.16 - 0.5, 0.05 + 0.12 + 2 + 0.25)
  EXPECT_LT((Accelerometer::predict(state, params, kGravity_w) - Vector3d(1.70, 2.09, 2.42)).norm(), 1e-14);
}

TEST(Gyroscope, GSensitivityByHand) {
  Gyroscope::Params<double> params;
  params.g_sensitivity << 0, 0, 0.001, 0, 0, 0.002, 0, 0, 0.003;
  params.scale = Vector3d(0.5, 0.0, 0.0);
  BodyState state;
  state.omega_b = Vector3d(2.0, 3.0, 4.0);
  const Vector3d expected(3.0 + 0.00981, 3.0 + 0.01962, 4.0 + 0.02943);
  EXPECT_LT((Gyroscope::predict(state, params, kGravity_w) - expected).norm(), 1e-14);
}

TEST(SpecificForce, AgreesWithTheAccelerationOfThePoint) {
  // x_i(t) = p + R p_b_i along a constant-alpha turn, differentiated twice by differences, is what the IMU feels.
  const auto point = testing::generic_point<Accelerometer>(7);
  const BodyState& s = point.state;
  const Vector3d p_b_i = point.params.T_b_i.p;
  const auto x_i = [&](double t) -> Vector3d {
    // Third order in t: exp(omega t + alpha t^2 / 2) has the right first and second derivative at t = 0.
    const Matrix3d R = s.R_w_b * SO3::exp<double>(s.omega_b * t + s.alpha_b * (t * t / 2));
    return s.p_w + s.v_w * t + s.a_w * (t * t / 2) + R * p_b_i;
  };
  const double h = 1e-4;
  const Vector3d a_i_w = (x_i(h) - 2.0 * x_i(0) + x_i(-h)) / (h * h);
  const Vector3d f_i = (s.R_w_b * point.params.T_b_i.R).transpose() * (a_i_w - point.g_w);
  EXPECT_LT((specific_force(s, point.params.T_b_i, point.g_w) - f_i).norm(), 1e-6);
}

TEST(SpecificForce, DoesNotDependOnTheWorldFrame) {
  const auto point = testing::generic_point<Accelerometer>(8);
  const Matrix3d R = SO3::exp<double>(Vector3d(0.3, -1.2, 2.0));
  BodyState turned = point.state;
  turned.R_w_b = R * turned.R_w_b;
  turned.a_w = R * turned.a_w;
  const Vector3d f_i = specific_force(point.state, point.params.T_b_i, point.g_w);
  EXPECT_LT((specific_force<double>(turned, point.params.T_b_i, R * point.g_w) - f_i).norm(), 1e-13);
}

void expect_refused(const Rig& rig, const std::string& field) {
  try {
    require_valid(rig);
    FAIL() << "accepted a wrong " << field;
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUsage);
    EXPECT_NE(error.diagnostic().message.find(field), std::string::npos) << error.what();
  }
}

TEST(Rig, RefusesWrongValuesByName) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](auto change) {
    Rig rig{{Imu{}}};
    change(rig.imus[0]);
    return rig;
  };
  EXPECT_NO_THROW(require_valid(Rig{{Imu{}}}));
  expect_refused(with([](Imu& imu) { imu.name = ""; }), "name");
  expect_refused(with([](Imu& imu) { imu.rate_hz = 0.0; }), "rate_hz");
  expect_refused(with([](Imu& imu) { imu.rate_hz = kNan; }), "rate_hz");
  expect_refused(with([](Imu& imu) { imu.noise.gyro.white = -1e-9; }), "gyroscope noise white");
  expect_refused(with([](Imu& imu) { imu.noise.accel.range = kNan; }), "accelerometer noise range");
  expect_refused(with([](Imu& imu) { imu.gyroscope.g_sensitivity(2, 1) = kNan; }), "gyroscope g_sensitivity");
  expect_refused(with([](Imu& imu) { imu.accelerometer.T_b_i.p.x() = HUGE_VAL; }), "accelerometer T_b_i");
  expect_refused(with([](Imu& imu) { imu.accelerometer.time_offset_s = kNan; }), "accelerometer time_offset");
}

TEST(Rig, NamesAreUnique) {
  Rig rig{{Imu{.name = "imu0"}, Imu{.name = "imu1", .rate_hz = 1000.0}}};
  EXPECT_NO_THROW(require_valid(rig));
  EXPECT_EQ(find_imu(rig, "imu1")->rate_hz, 1000.0);
  EXPECT_EQ(find_imu(rig, "imu2"), nullptr);
  rig.imus[1].name = "imu0";
  expect_refused(rig, "imu0");
}

}  // namespace
}  // namespace vispline
