// The normal equations of a track against those of central differences of its residuals.
#include "vispline/estimate/track.h"

#include <gtest/gtest.h>

#include "vispline/estimate/estimate_testing.h"
#include "vispline/estimate/track_columns.h"
#include "vispline/estimate/view_sums.h"

namespace vispline {
namespace {

/// One landmark 2.5 m in front, seen by both cameras where it really is.
struct Example {
  Problem problem;
  Columns columns;

  explicit Example(LandmarkUnknowns unknowns, const CurveShape& shape = {}) {
    State& state = problem.start;
    state = testing::generic_state(shape, 21);
    problem.parameters = testing::all_free(state);
    problem.track_model = {unknowns, {0.5, 0.8}, {}};
    const Camera& camera = state.rig.cameras[0];
    Track track{0, {{0, time_from_ns(200'000'000), {300.0, 220.0}}}};
    state.landmarks.push_back({*camera.lens.unproject(track.sightings[0].px), 0.4});
    const Pose T_w_b = state.curve->pose({track.sightings[0].stamp, camera.delay_s(track.sightings[0].px)});
    const HomogeneousPoint point = state.landmarks[0].in_world(T_w_b * camera.T_c_b.inverse());
    for (int i = 1; i < 9; ++i)
      track.sightings.push_back(see(state, i % 2, time_from_ns(200'000'000 + 90'500'000L * i), point));
    problem.tracks.push_back(track);
    columns = assign_columns(state, problem.parameters);
  }

  static Sighting see(const State& state, std::size_t c, Time stamp, const HomogeneousPoint& point) {
    const Camera& camera = state.rig.cameras[c];
    Vector2d px(300.0, 240.0);
    for (int i = 0; i < 50; ++i) {
      const Pose T_w_b = state.curve->pose({stamp, camera.delay_s(px)});
      px = *camera.lens.project(point.seen_from(T_w_b * camera.T_c_b.inverse()));
    }
    return {c, stamp, px};
  }

  Eigen::VectorXd residuals(const Eigen::VectorXd& delta, const Vector3d& delta_landmark) const {
    const State state = moved(problem.start, columns, problem.parameters, delta, problem, {delta_landmark});
    const TrackResiduals r = evaluate_track(state, problem.track_model, problem.tracks[0]);
    EXPECT_EQ(r.lost, 0u);
    Eigen::VectorXd stacked(2 * static_cast<Eigen::Index>(r.r.size()));
    for (std::size_t i = 0; i < r.r.size(); ++i) stacked.segment<2>(2 * static_cast<Eigen::Index>(i)) = r.r[i];
    return stacked;
  }
};

void expect_normal_equations(const Example& e) {
  const int n = e.columns.layout.columns, size = e.problem.track_model.size();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd J(e.residuals(zero, Vector3d::Zero()).size(), n + size);
  for (int c = 0; c < n + size; ++c) {
    const double h = testing::step_of(e.problem.parameters, c);
    const Eigen::VectorXd d = c < n ? Eigen::VectorXd(h * Eigen::VectorXd::Unit(n, c)) : zero;
    const Vector3d l = c < n ? Vector3d(Vector3d::Zero()) : Vector3d(h * Vector3d::Unit(c - n));
    J.col(c) = (e.residuals(d, l) - e.residuals(-d, -l)) / (2.0 * h);
  }
  const Eigen::MatrixXd expected = J.transpose() * J;

  const Track& track = e.problem.tracks[0];
  const TrackColumns local(e.problem.start, e.columns, track);
  ViewSums views(e.problem.start, e.columns);
  const TrackBlock block =
      linearize_track(e.problem.start, e.columns, local, e.problem.track_model, track, Weights::kKept, views);
  EXPECT_LT(block.cost, 1e-12);
  Skyline H(n);
  H.couple(block.column);
  H.allocate();
  views.add_to(H);
  if (block.C.size() > 0) H.add_products(block.column, block.C, block.reference, block.Q);
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(n + size, n + size);
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c <= r; ++c) {
      if (c / Skyline::kTile < H.first(r / Skyline::kTile)) continue;
      found(r, c) = H.tile(r / Skyline::kTile, c / Skyline::kTile)(r % Skyline::kTile, c % Skyline::kTile);
    }
  }
  for (std::size_t c = 0; c < block.column.size(); ++c) {
    found.block(n, block.column[c], size, 1) += block.W_t.row(static_cast<Eigen::Index>(c)).transpose();
  }
  found.bottomRightCorner(size, size) = block.H_l.topLeftCorner(size, size);
  // A step of the track's landmark is in the world: back to the landmark's own.
  found = Eigen::MatrixXd(found.selfadjointView<Eigen::Lower>());
  Eigen::MatrixXd own = Eigen::MatrixXd::Identity(n + size, n + size);
  for (std::size_t c = 0; block.carry_t.size() > 0 && c < block.reference.size(); ++c) {
    own.block(n, block.reference[c], size, 1) += block.carry_t.row(static_cast<Eigen::Index>(c)).transpose();
  }
  found = (own.transpose() * found * own).eval();
  const Eigen::VectorXd scale = expected.diagonal().cwiseSqrt().cwiseMax(1.0);
  for (int r = 0; r < n + size; ++r) {
    for (int c = 0; c <= r; ++c) {
      EXPECT_NEAR(found(r, c) / (scale(r) * scale(c)), expected(r, c) / (scale(r) * scale(c)), 2e-6) << r << ", " << c;
    }
  }
}

TEST(Track, NormalEquationsOfAPoint) {
  expect_normal_equations(Example(LandmarkUnknowns::kPoint));
  expect_normal_equations(Example(LandmarkUnknowns::kPoint, {SplineKind::kSplit, 5, from_seconds(0.15)}));
}

TEST(Track, NormalEquationsOfAnInverseDepth) { expect_normal_equations(Example(LandmarkUnknowns::kInverseDepth)); }

TEST(Track, AtInfinityNothingIsSingular) {
  Example e(LandmarkUnknowns::kPoint);
  e.problem.start.landmarks[0].inverse_distance = 0.0;
  const TrackResiduals r = evaluate_track(e.problem.start, e.problem.track_model, e.problem.tracks[0]);
  EXPECT_EQ(r.lost, 0u);
  EXPECT_TRUE(std::isfinite(r.cost));
}

}  // namespace
}  // namespace vispline
