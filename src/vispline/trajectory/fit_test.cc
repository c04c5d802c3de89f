#include "vispline/trajectory/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/trajectory/analytic.h"
#include "vispline/trajectory/fit_spline.h"
#include "vispline/trajectory/spline_testing.h"

namespace vispline {
namespace {

Signal<Pose> sampled(const Trajectory& truth, double rate_hz, double sigma_m = 0.0, double sigma_rad = 0.0) {
  const RandomStream random(17, "pose noise");
  const SampleClock clock{truth.span().begin, rate_hz};
  Signal<Pose> poses;
  for (std::int64_t i = 0; clock(i) <= truth.span().end; ++i) {
    const auto n = [&](int k) { return random.normal(static_cast<std::uint64_t>(6 * i + k)); };
    const Pose T = truth.at(clock(i))->T_w_b();
    poses.push_back(clock(i), {T.R * SO3::exp<double>(sigma_rad * Vector3d(n(0), n(1), n(2))),
                               T.p + sigma_m * Vector3d(n(3), n(4), n(5))});
  }
  return poses;
}

struct StateError {
  double position = 0.0, acceleration = 0.0, rate = 0.0;  // rms per axis
};

StateError state_error(const Trajectory& curve, const Trajectory& truth) {
  StateError e;
  int count = 0;
  const Duration margin = from_seconds(1.0);
  for (Time t = truth.span().begin + margin; t < truth.span().end - margin; t += Duration(7'345'678), ++count) {
    const BodyState a = *curve.at(t), b = *truth.at(t);
    e.position += (a.p_w - b.p_w).squaredNorm();
    e.acceleration += (a.a_w - b.a_w).squaredNorm();
    e.rate += (a.omega_b - b.omega_b).squaredNorm();
  }
  const double scale = 1.0 / (3.0 * count);
  return {std::sqrt(e.position * scale), std::sqrt(e.acceleration * scale), std::sqrt(e.rate * scale)};
}

Trajectory ellipse() { return *analytic_trajectory("ellipse", time_from_ns(1'000'000'007), from_seconds(20.0)); }

TEST(Fit, OfTheEllipseIsAsCloseAsACubicSplineCanBe) {
  // Interpolation at knots 0.1 s apart leaves 0.012 mm and 27 mm/s^2 rms over all axes; these are per axis.
  for (const SplineKind kind : {SplineKind::kJoint, SplineKind::kSplit}) {
    const auto fit = fit_trajectory(sampled(ellipse(), 200.0), {.kind = kind, .spacing_s = 0.1});
    const StateError error = state_error(fit.trajectory, ellipse());
    EXPECT_LT(error.position, 2e-5);
    EXPECT_LT(error.acceleration, 0.030);
    EXPECT_TRUE(fit.converged);
    EXPECT_EQ(fit.knots, 203u);
    EXPECT_TRUE(fit.gaps.empty());
  }
}

TEST(Fit, HigherOrdersAreCloserOnSmoothMotion) {
  double before = 1.0;
  for (const int order : {4, 5, 6}) {
    const auto fit = fit_trajectory(sampled(ellipse(), 200.0), {.order = order, .spacing_s = 0.1});
    const double error = state_error(fit.trajectory, ellipse()).position;
    EXPECT_LT(error, before) << "order " << order;
    before = error;
  }
}

TEST(Fit, ChoosesKnotsThatBeatDifferencesOfNoisyPoses) {
  const Trajectory dance = *analytic_trajectory("dance", Time{}, from_seconds(30.0));
  const double sigma_m = 2e-4, sigma_rad = 2e-3;
  const auto poses = sampled(dance, 120.0, sigma_m, sigma_rad);
  const auto fit = fit_trajectory(poses);
  const StateError error = state_error(fit.trajectory, dance);
  // A central difference of two noisy attitudes 1/60 s apart: sigma sqrt(2) 60 = 0.17 rad/s.
  EXPECT_LT(error.rate, 0.25 * sigma_rad * std::sqrt(2.0) * 60.0);
  EXPECT_LT(error.position, sigma_m);
  EXPECT_NEAR(fit.rotation_rad.rms, sigma_rad, 0.15 * sigma_rad);
  EXPECT_NEAR(fit.position_m.rms, sigma_m, 0.15 * sigma_m);
}

TEST(Fit, OfExactPosesConvergesAndIsExact) {
  const Trajectory dance = *analytic_trajectory("dance", Time{}, from_seconds(20.0));
  const auto fit = fit_trajectory(sampled(dance, 200.0));
  EXPECT_TRUE(fit.converged);
  EXPECT_LT(fit.iterations, 10);
  EXPECT_EQ(fit.outliers, 0u);
  const StateError error = state_error(fit.trajectory, dance);
  EXPECT_LT(error.position, 1e-7);
  EXPECT_LT(error.acceleration, 1e-3);
}

TEST(Fit, CanBeStopped) {
  struct Stop {};
  const auto poses = sampled(ellipse(), 200.0);
  EXPECT_THROW(fit_trajectory(poses, {.spacing_s = 0.1, .poll = [] { throw Stop{}; }}), Stop);
}

TEST(Fit, LeavesOutliersOutAndCountsThem) {
  const Trajectory dance = *analytic_trajectory("dance", Time{}, from_seconds(20.0));
  auto poses = sampled(dance, 120.0, 2e-4, 2e-3);
  const StateError clean = state_error(fit_trajectory(poses).trajectory, dance);
  std::size_t outliers = 0;
  for (std::size_t i = 50; i < poses.size(); i += 211, ++outliers) poses.value[i].p += Vector3d(0.3, -0.2, 0.1);
  const auto fit = fit_trajectory(poses);
  EXPECT_EQ(fit.outliers, outliers);
  EXPECT_LT(state_error(fit.trajectory, dance).position, 1.5 * clean.position);
}

TEST(Fit, BridgesShortGapsAndNamesLongOnes) {
  const auto whole = sampled(ellipse(), 100.0, 1e-4, 1e-3);
  Signal<Pose> poses;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (i % 97 != 3 && !(i > 900 && i < 1000)) poses.push_back(whole.time[i], whole.value[i]);
  }
  const auto fit = fit_trajectory(poses, {.spacing_s = 0.1});
  ASSERT_EQ(fit.gaps.size(), 1u);
  EXPECT_EQ(fit.gaps[0].begin, whole.time[900]);
  EXPECT_EQ(fit.gaps[0].end, whole.time[1000]);
  EXPECT_TRUE(fit.in_gap(whole.time[950]));
  EXPECT_FALSE(fit.in_gap(whole.time[900]));
  EXPECT_FALSE(fit.in_gap(whole.time[100]));
  // The guess inside is smooth: it does not run away.
  EXPECT_LT((fit.trajectory.at(whole.time[950])->p_w - whole.value[950].p).norm(), 1.0);
}

TEST(Fit, SpansTheDataFromFirstToLastPose) {
  const auto poses = sampled(ellipse(), 93.7);
  const auto fit = fit_trajectory(poses, {.spacing_s = 0.0777});
  EXPECT_TRUE(fit.trajectory.span().contains(poses.time.front()));
  EXPECT_TRUE(fit.trajectory.span().contains(poses.time.back()));
}

TEST(Fit, FewPosesNeedAGivenSpacing) {
  const auto poses = sampled(*analytic_trajectory("ellipse", Time{}, from_seconds(0.3)), 100.0);
  EXPECT_THROW(fit_trajectory(poses), Error);
  const auto fit = fit_trajectory(poses, {.spacing_s = 0.1});
  EXPECT_LT(fit.position_m.rms, 1e-3);
  EXPECT_FALSE(fit.spectrum.has_value());
  EXPECT_THROW(fit_trajectory({}, {.spacing_s = 0.1}), Error);
  EXPECT_THROW(fit_trajectory(poses, {.order = 7, .spacing_s = 0.1}), Error);
  EXPECT_THROW(fit_trajectory(poses, {.spacing_s = -1.0}), Error);
}

TEST(Fit, OnePoseIsAConstantCurve) {
  Signal<Pose> poses;
  poses.push_back(Time{}, {SO3::exp<double>(Vector3d(0.1, 0.2, 0.3)), Vector3d(1, 2, 3)});
  const auto fit = fit_trajectory(poses, {.spacing_s = 0.1});
  EXPECT_LT((fit.trajectory.at(Time{})->p_w - Vector3d(1, 2, 3)).norm(), 1e-9);
  EXPECT_LT(fit.trajectory.at(Time{})->v_w.norm(), 1e-6);
}

TEST(SplineFit, WorksOnAnyGroup) {
  const auto knots = testing::random_knots<SO3>(3, 20, 0.2);
  const Spline<SO3, 5> truth(Time{}, from_seconds(0.1), knots);
  Signal<Matrix3d> measured;
  for (Time t = truth.span().begin; t <= truth.span().end; t += Duration(3'000'001)) {
    measured.push_back(t, truth.element(t));
  }
  SplineFitOptions<SO3> options;
  options.spacing = from_seconds(0.1);
  options.sigma.setConstant(1e-4);
  const auto fit = SplineFitter<SO3, 5>(measured, options).run();
  EXPECT_TRUE(fit.converged);
  for (const auto& r : fit.residual) EXPECT_LT(r.norm(), 1e-5);
}

}  // namespace
}  // namespace vispline
