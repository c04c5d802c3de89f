#include "vispline/trajectory/analytic.h"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

const Time kStart = time_from_ns(1'403'715'273'262'142'976);

Trajectory curve(std::string_view name, Duration duration = std::chrono::seconds(60)) {
  return *analytic_trajectory(name, kStart, duration);
}

/// The matrix that turns Euler-angle rates into body rates, written out by hand.
Matrix3d euler_rates_to_body(double roll, double pitch) {
  const double sr = std::sin(roll), cr = std::cos(roll), sp = std::sin(pitch), cp = std::cos(pitch);
  Matrix3d E;
  E << 1, 0, -sp, 0, cr, sr * cp, 0, -sr, cr * cp;
  return E;
}

void expect_course_formulas(const BodyState& state, double t) {
  const double K = std::numbers::pi / 10, s = std::sin(K * t), c = std::cos(K * t), z = 10 * K;
  const Vector3d p(15 * c + 5, 20 * s + 5, std::sin(z * t) + 5);
  const Vector3d v(-15 * K * s, 20 * K * c, z * std::cos(z * t));
  const Vector3d a(-15 * K * K * c, -20 * K * K * s, -z * z * std::sin(z * t));
  const double roll = 0.1 * std::cos(t), pitch = 0.2 * std::sin(t);
  const Vector3d rates(-0.1 * std::sin(t), 0.2 * std::cos(t), K);
  const Matrix3d R = (Eigen::AngleAxisd(K * t, Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
                      Eigen::AngleAxisd(roll, Vector3d::UnitX()))
                         .toRotationMatrix();
  EXPECT_LT((state.p_w - p).norm(), 1e-12);
  EXPECT_LT((state.v_w - v).norm(), 1e-12);
  EXPECT_LT((state.a_w - a).norm(), 1e-12);
  EXPECT_LT((state.R_w_b - R).norm(), 1e-12);
  EXPECT_LT((state.omega_b - euler_rates_to_body(roll, pitch) * rates).norm(), 1e-12);
}

TEST(Analytic, EllipseEqualsTheCourseFormulas) {
  const Trajectory ellipse = curve("ellipse", std::chrono::seconds(20));
  for (int i = 0; i <= 80; ++i) {
    expect_course_formulas(*ellipse.at(kStart + std::chrono::milliseconds(250 * i)), 0.25 * i);
  }
}

class EveryCurve : public testing::TestWithParam<std::string> {};

TEST_P(EveryCurve, DerivativesAgreeWithCentralDifferences) {
  const Trajectory trajectory = curve(GetParam());
  const Duration h = std::chrono::microseconds(100);
  const double two_h = 2 * to_seconds(h);
  for (int i = 1; i <= 40; ++i) {
    const Time time = kStart + std::chrono::milliseconds(1371 * i);
    const BodyState now = *trajectory.at(time), before = *trajectory.at(time - h), after = *trajectory.at(time + h);
    const Matrix3d dR = (after.R_w_b - before.R_w_b) / two_h;
    EXPECT_LT((now.omega_b - vee<double>(now.R_w_b.transpose() * dR)).norm(), 2e-6);
    EXPECT_LT((now.v_w - (after.p_w - before.p_w) / two_h).norm(), 2e-6);
    EXPECT_LT((now.a_w - (after.v_w - before.v_w) / two_h).norm(), 2e-6);
    EXPECT_LT((now.alpha_b - (after.omega_b - before.omega_b) / two_h).norm(), 2e-6);
  }
}

TEST_P(EveryCurve, RotationStaysARotationForADay) {
  const Trajectory trajectory = curve(GetParam(), std::chrono::hours(25));
  for (int hour = 0; hour <= 25; ++hour) {
    const Matrix3d R = trajectory.at(kStart + std::chrono::hours(hour))->R_w_b;
    EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_GT(R.determinant(), 0.0);
  }
}

TEST_P(EveryCurve, IsDefinedOnItsClosedSpanOnly) {
  const Trajectory trajectory = curve(GetParam(), std::chrono::seconds(3));
  EXPECT_TRUE(trajectory.at(kStart));
  EXPECT_TRUE(trajectory.at(kStart + std::chrono::seconds(3)));
  EXPECT_FALSE(trajectory.at(kStart - Duration(1)));
  EXPECT_FALSE(trajectory.at(kStart + std::chrono::seconds(3) + Duration(1)));
}

INSTANTIATE_TEST_SUITE_P(Analytic, EveryCurve, testing::ValuesIn(analytic_names()), [](const auto& test) {
  std::string name = test.param;
  std::erase(name, '-');
  return name;
});

TEST(Analytic, EllipseRepeatsAfterADay) {
  const Trajectory ellipse = curve("ellipse", std::chrono::hours(24));
  const Duration phase = std::chrono::milliseconds(4321);
  const BodyState first = *ellipse.at(kStart + phase), last = *ellipse.at(kStart + phase + std::chrono::hours(23));
  EXPECT_LT((first.p_w - last.p_w).norm(), 1e-9);  // 23 h are 4140 rounds of 20 s
  EXPECT_LT((first.a_w - last.a_w).norm(), 1e-9);
}

TEST(Analytic, StaticIsLevelAtTheOriginAndStill) {
  const BodyState state = *curve("static").at(kStart + std::chrono::seconds(7));
  EXPECT_EQ(state.R_w_b, Matrix3d::Identity());
  for (const Vector3d& zero : {state.p_w, state.v_w, state.omega_b, state.a_w, state.alpha_b}) {
    EXPECT_EQ(zero, Vector3d::Zero());
  }
}

TEST(Analytic, LineAndFigureEightLookAhead) {
  for (int i = 0; i <= 59; ++i) {
    const Time time = kStart + std::chrono::seconds(i);
    const BodyState line = *curve("line").at(time), eight = *curve("figure-eight").at(time);
    EXPECT_NEAR(line.R_w_b.col(0).dot(line.v_w), line.v_w.norm(), 1e-12);
    EXPECT_GE(line.v_w.norm(), 0.5);
    const Vector3d ahead = eight.R_w_b.col(0);
    EXPECT_NEAR(ahead.head<2>().normalized().dot(eight.v_w.head<2>().normalized()), 1.0, 1e-12);
  }
}

struct Excitation {
  Vector3d peak = Vector3d::Zero(), rms = Vector3d::Zero();
};

template <class Field>
Excitation excitation(const Trajectory& trajectory, Field BodyState::*field) {
  Excitation result;
  constexpr int kCount = 6000;
  for (int i = 0; i < kCount; ++i) {
    const Vector3d x = (*trajectory.at(kStart + std::chrono::milliseconds(10 * i))).*field;
    result.peak = result.peak.cwiseMax(x.cwiseAbs());
    result.rms += x.cwiseAbs2() / kCount;
  }
  result.rms = result.rms.cwiseSqrt();
  return result;
}

TEST(Analytic, DanceExcitesEveryAxis) {
  const Trajectory dance = curve("dance");
  const Excitation omega = excitation(dance, &BodyState::omega_b), a = excitation(dance, &BodyState::a_w);
  const Excitation alpha = excitation(dance, &BodyState::alpha_b), v = excitation(dance, &BodyState::v_w);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(omega.rms[axis], 0.6) << axis;
    EXPECT_LT(omega.peak[axis], 2.5) << axis;
    EXPECT_GT(a.rms[axis], 1.5) << axis;
    EXPECT_LT(a.peak[axis], 4.5) << axis;
  }
  const Eigen::IOFormat row(4, 0, " ", " ");
  RecordProperty("omega_peak", (std::stringstream() << omega.peak.transpose().format(row)).str());
  RecordProperty("omega_rms", (std::stringstream() << omega.rms.transpose().format(row)).str());
  RecordProperty("a_peak", (std::stringstream() << a.peak.transpose().format(row)).str());
  RecordProperty("a_rms", (std::stringstream() << a.rms.transpose().format(row)).str());
  RecordProperty("alpha_peak", (std::stringstream() << alpha.peak.transpose().format(row)).str());
  RecordProperty("v_peak", (std::stringstream() << v.peak.transpose().format(row)).str());
}

TEST(Analytic, DanceStartsFromRest) {
  const BodyState state = *curve("dance").at(kStart);
  EXPECT_EQ(state.R_w_b, Matrix3d::Identity());
  for (const Vector3d& zero : {state.p_w, state.v_w, state.omega_b, state.a_w, state.alpha_b}) {
    EXPECT_LT(zero.norm(), 1e-15);
  }
}

TEST(Analytic, UnknownNameIsAbsentAndNegativeDurationIsAnError) {
  EXPECT_FALSE(analytic_trajectory("elipse", kStart, Duration(1)));
  EXPECT_THROW(analytic_trajectory("ellipse", kStart, Duration(-1)), Error);
}

}  // namespace
}  // namespace vispline
