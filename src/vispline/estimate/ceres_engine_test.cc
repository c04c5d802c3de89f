// Two engines, one minimum: everything free, readings with noise, a start that is off.
#include "vispline/estimate/ceres_engine.h"

#include <gtest/gtest.h>

#include "vispline/estimate/estimate_testing.h"
#include "vispline/estimate/imu_measurement.h"
#include "vispline/estimate/pose_measurement.h"
#include "vispline/estimate/priors.h"

namespace vispline {
namespace {

constexpr double kGyroSigma = 0.005, kAccelSigma = 0.05;

/// One second of two IMUs and two cameras that see the same points; a prior on every parameter.
struct Example {
  std::vector<Time> times;
  std::vector<std::vector<ImuSample>> samples{2};
  Problem problem;

  Example(LandmarkUnknowns unknowns, const CurveShape& shape, double huber) {
    const State truth = testing::generic_state(shape, 31);
    testing::Generic generic(32);
    problem.start = truth;
    problem.track_model = {unknowns, {0.5, 0.8}, {huber}};
    problem.parameters = testing::all_free(truth);
    for (Parameter& parameter : problem.parameters) {
      double sigma = 0.01;
      if (parameter.name.ends_with("time_offset")) sigma = 1e-3;
      if (parameter.name.ends_with("line_delay")) sigma = 1e-6;
      parameter.treatment = {Role::kPrior, sigma};
      problem.measurements.push_back(prior_measurement(truth, parameter));
    }
    const Time middle = time_from_ns(500'000'000);
    problem.measurements.push_back(gauge_measurement({middle, truth.curve->pose({middle})}));
    problem.measurements.push_back(smoothness_measurement({}, 0, truth.curve->knots() - 1));
    read_imus(truth, huber, generic);
    see_points(truth, generic);
    std::vector<Vector6d> delta(truth.curve->knots());
    for (Vector6d& d : delta) d = generic.vector(6, 0.02);
    problem.start.curve->retract(delta);
    for (InverseDepthLandmark& landmark : problem.start.landmarks) landmark.inverse_distance *= 1.1;
  }

  void read_imus(const State& truth, double huber, testing::Generic& generic) {
    for (int i = 0; i < 200; ++i) times.push_back(time_from_ns(20'000'000 + 5'000'000L * i));
    for (std::size_t i = 0; i < 2; ++i) {
      const Imu& imu = truth.rig.imus[i];
      for (const Time time : times) {
        const BodyState state = truth.curve->state({time, imu.gyroscope.time_offset_s});
        samples[i].push_back(
            {Gyroscope::predict<double>(state, imu.gyroscope, truth.g_w) + generic.vector(kGyroSigma),
             Accelerometer::predict<double>(state, imu.accelerometer, truth.g_w) + generic.vector(kAccelSigma)});
      }
      for (std::size_t begin = 0; begin < times.size(); begin += 10) {
        problem.measurements.push_back(imu_measurement(
            truth, {i, {&times[begin], 10}, {&samples[i][begin], 10}, {kGyroSigma, kAccelSigma}, {huber}}));
      }
    }
  }

  void see_points(const State& truth, testing::Generic& generic) {
    const Camera& camera = truth.rig.cameras[0];
    for (int p = 0; p < 20; ++p) {
      const Vector2d px(200.0 + 13.0 * p, 400.0 - 17.0 * p + generic.number(5.0));
      Track track{static_cast<std::size_t>(p), {{0, time_from_ns(150'000'000 + 1'000'000L * p), px}}};
      const InverseDepthLandmark landmark{*camera.lens.unproject(px), 0.3 + 0.01 * p};
      const Pose T_w_b = truth.curve->pose({track.sightings[0].stamp, camera.delay_s(px)});
      const HomogeneousPoint point = landmark.in_world(T_w_b * camera.T_c_b.inverse());
      for (int i = 1; i < 9; ++i) {
        see(truth, static_cast<std::size_t>(i % 2), time_from_ns(150'000'000 + 97'500'000L * i), point, generic, track);
      }
      problem.start.landmarks.push_back(landmark);
      problem.tracks.push_back(track);
    }
  }

  static void see(const State& truth, std::size_t c, Time stamp, const HomogeneousPoint& point,
                  testing::Generic& generic, Track& track) {
    const Camera& camera = truth.rig.cameras[c];
    Vector2d px(300.0, 240.0);
    for (int i = 0; i < 30; ++i) {
      const Pose T_w_b = truth.curve->pose({stamp, camera.delay_s(px)});
      const auto image = camera.lens.project(point.seen_from(T_w_b * camera.T_c_b.inverse()));
      if (!image) return;
      px = *image;
    }
    track.sightings.push_back({c, stamp, px + Vector2d(generic.number(0.5), generic.number(0.5))});
  }

  Solution solved(Engine engine, std::size_t threads) {
    SolveOptions options;
    options.engine = engine;
    options.threads = threads;
    options.least_decrease = 1e-11;
    options.relative_decrease = 1e-14;
    options.max_iterations = 100;
    return solve(problem, options);
  }
};

void expect_same_minimum(Example example) {
  const Solution own = example.solved(Engine::kOwn, 1), other = example.solved(Engine::kCeres, 1);
  ASSERT_EQ(own.status, SolveStatus::kConverged);
  ASSERT_EQ(other.status, SolveStatus::kConverged);
  EXPECT_LT(own.cost, 0.5 * own.first_cost);
  EXPECT_NEAR(other.cost / own.cost, 1.0, 1e-6);
  ASSERT_TRUE(own.full_rank);
  int at = 0;
  for (const Parameter& parameter : own.parameters) {
    const Eigen::VectorXd difference = parameter.delta(own.state, other.state);
    for (Eigen::Index i = 0; i < parameter.size; ++i, ++at) {
      EXPECT_LT(std::abs(difference(i)), 1e-3 * std::sqrt(own.covariance(at, at))) << parameter.name;
    }
  }
}

TEST(CeresEngine, ReachesTheMinimumOfOurs) {
  expect_same_minimum(Example(LandmarkUnknowns::kPoint, {}, 0.0));
  expect_same_minimum(Example(LandmarkUnknowns::kInverseDepth, {SplineKind::kSplit, 5, from_seconds(0.12)}, 0.0));
}

TEST(CeresEngine, RobustLossIsTheSame) { expect_same_minimum(Example(LandmarkUnknowns::kPoint, {}, 1.0)); }

TEST(CeresEngine, ThreadsDoNotChangeAByte) {
  Example example(LandmarkUnknowns::kPoint, {}, 1.0);
  for (const Engine engine : {Engine::kOwn, Engine::kCeres}) {
    const Solution one = example.solved(engine, 1), three = example.solved(engine, 3);
    EXPECT_EQ(one.cost, three.cost);
    ASSERT_EQ(one.iterations.size(), three.iterations.size());
    for (std::size_t k = 0; k < one.state.curve->knots(); ++k) {
      EXPECT_EQ(one.state.curve->knot_poses()[k].p, three.state.curve->knot_poses()[k].p);
    }
  }
}

/// The curve reaches a second further than anything that was measured.
TEST(Solve, KnotsThatNothingMeasuresStay) {
  Example example(LandmarkUnknowns::kPoint, {}, 0.0);
  const auto& knots = example.problem.start.curve->knot_poses();
  const TimeSpan span = example.problem.start.curve->span();
  std::size_t k = 0;
  example.problem.start.curve = make_curve({}, {span.begin, span.end + from_seconds(1.0)},
                                           [&](Time) { return knots[std::min(k++, knots.size() - 1)]; });
  const Solution own = example.solved(Engine::kOwn, 1);
  EXPECT_EQ(own.status, SolveStatus::kConverged);
  EXPECT_FALSE(own.full_rank);
}

}  // namespace
}  // namespace vispline
