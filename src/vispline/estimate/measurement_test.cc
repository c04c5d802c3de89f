// Rows of every kind of measurement against central differences of themselves, at generic values.
#include "vispline/estimate/measurement.h"

#include <gtest/gtest.h>

#include "vispline/estimate/estimate_testing.h"
#include "vispline/estimate/imu_measurement.h"
#include "vispline/estimate/pose_measurement.h"
#include "vispline/estimate/priors.h"
#include "vispline/estimate/reprojection.h"
#include "vispline/estimate/target_measurement.h"

namespace vispline {
namespace {

using testing::Generic;

struct Worst {
  double error = 0.0, at = 0.0;
  Eigen::Index row = 0;
  int column = 0;
};

Eigen::VectorXd residual_at(const Measurement& measurement, const State& state, const Columns& columns) {
  Rows rows;
  measurement.evaluate(state, columns, false, rows);
  return rows.r;
}

/// Largest difference between J and central differences, relative to the largest entry of its column.
Worst worst_column(const Measurement& measurement, const State& state, std::vector<Parameter> parameters) {
  const Columns columns = assign_columns(state, parameters);
  const Problem no_tracks;
  Rows rows;
  measurement.evaluate(state, columns, true, rows);
  EXPECT_LT((rows.r - residual_at(measurement, state, columns)).norm(), 1e-12 * (1.0 + rows.r.norm()));
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows.r.size(), columns.layout.columns);
  const Eigen::MatrixXd local = rows.jacobian();
  for (std::size_t c = 0; c < rows.column.size(); ++c) J.col(rows.column[c]) += local.col(static_cast<Eigen::Index>(c));
  Worst worst;
  for (int column = 0; column < columns.layout.columns; ++column) {
    const double step = testing::step_of(parameters, column);
    const auto moved_by = [&](double h) {
      const Eigen::VectorXd delta = h * Eigen::VectorXd::Unit(columns.layout.columns, column);
      return residual_at(measurement, moved(state, columns, parameters, delta, no_tracks, {}), columns);
    };
    const Eigen::VectorXd numeric = (moved_by(step) - moved_by(-step)) / (2.0 * step);
    Eigen::Index row = 0;
    const double error = (numeric - J.col(column)).cwiseAbs().maxCoeff(&row) / (1.0 + numeric.cwiseAbs().maxCoeff());
    if (error > worst.error) worst = {error, numeric(row), row, column};
  }
  return worst;
}

std::vector<CurveShape> shapes() {
  return {{SplineKind::kJoint, 4, from_seconds(0.1)},
          {SplineKind::kSplit, 4, from_seconds(0.1)},
          {SplineKind::kJoint, 5, from_seconds(0.13)},
          {SplineKind::kSplit, 6, from_seconds(0.09)}};
}

void expect_derivatives(const std::function<std::unique_ptr<Measurement>(const State&)>& make) {
  for (const CurveShape& shape : shapes()) {
    State state = testing::generic_state(shape, 11);
    state.bias_walks.resize(2);
    for (BiasWalk& walk : state.bias_walks) {
      walk.spacing = from_seconds(0.4);
      walk.node = {Vector6d::Constant(0.01), Vector6d::Constant(-0.03), Vector6d::LinSpaced(0.0, 0.02),
                   Vector6d::Zero()};
    }
    const Worst worst = worst_column(*make(state), state, testing::all_free(state));
    EXPECT_LT(worst.error, 2e-7) << "order " << shape.order << " kind " << static_cast<int>(shape.kind) << " row "
                                 << worst.row << " column " << worst.column << " value " << worst.at;
  }
}

const std::vector<Time>& times() {
  static const std::vector<Time> list = [] {
    std::vector<Time> t;
    for (int i = 0; i < 9; ++i) t.push_back(time_from_ns(421'234'567 + 25'000'000L * i));
    return t;
  }();
  return list;
}

TEST(Measurement, ImuRows) {
  std::vector<ImuSample> samples(times().size());
  Generic generic(5);
  for (ImuSample& s : samples) s = {generic.vector(1.0), generic.vector(5.0)};
  expect_derivatives([&](const State& state) { return imu_measurement(state, {1, times(), samples, {0.7, 2.0}, {}}); });
}

TEST(Measurement, ImuRowsWithTriadsOfTwoClocks) {
  const std::vector<ImuSample> samples(times().size());
  State state = testing::generic_state(shapes()[0], 12);
  state.rig.imus[0].accelerometer.time_offset_s = 0.011;
  const auto measurement = imu_measurement(state, {0, times(), samples, {0.7, 2.0}, {}});
  EXPECT_LT(worst_column(*measurement, state, testing::all_free(state)).error, 2e-7);
}

TEST(Measurement, PoseRows) {
  std::vector<Pose> poses;
  Generic generic(6);
  for (std::size_t i = 0; i < times().size(); ++i) poses.push_back(generic.pose(0.5, 0.7));
  expect_derivatives([&](const State& state) { return pose_measurement(state, {0, times(), poses, 0.5, 0.2, {}}); });
}

TEST(Measurement, GaugeRows) {
  for (const bool whole : {false, true}) {
    State state = testing::generic_state(shapes()[0], 13);
    const Gauge gauge{time_from_ns(333'000'000), Generic(4).pose(0.5, 0.3), whole};
    std::vector<Parameter> parameters = parameters_of(state);
    EXPECT_LT(worst_column(*gauge_measurement(gauge), state, parameters).error, 1e-6);
  }
}

TEST(Measurement, PriorRows) {
  State start = testing::generic_state(shapes()[0], 14), state = start;
  for (Parameter& parameter : testing::all_free(start)) {
    parameter.treatment = {Role::kPrior, 0.3};
    EXPECT_LT(worst_column(*prior_measurement(start, parameter), state, testing::all_free(state)).error, 1e-6)
        << parameter.name;
  }
  expect_derivatives([](const State& s) { return bias_walk_measurement(s, 1, 0.01, 0.02); });
  expect_derivatives([](const State&) { return smoothness_measurement({20.0, 30.0}, 2, 7); });
}

/// Points in front of the camera, measured where they are: the whitening then is constant to first order.
TargetFrame frame_of(const State& state, std::size_t camera) {
  TargetFrame frame{camera, time_from_ns(600'000'000), {}, {}, 0.7, {}};
  Generic generic(17);
  const Camera& c = state.rig.cameras[camera];
  for (int i = 0; i < 6; ++i) {
    Vector2d px(150.0 + 40.0 * i, 300.0 - 35.0 * i);
    const Pose T_w_b = state.curve->pose({frame.stamp, c.delay_s(px)});
    const Vector3d point = T_w_b * (c.T_c_b.inverse() * Vector3d(2.0 * *c.lens.unproject(px)));
    frame.px.push_back(px);
    frame.point.push_back(point);
  }
  return frame;
}

TEST(Measurement, TargetRows) {
  for (const std::size_t camera : {0, 1}) {
    expect_derivatives([&](const State& state) { return target_measurement(state, frame_of(state, camera)); });
  }
}

}  // namespace
}  // namespace vispline
