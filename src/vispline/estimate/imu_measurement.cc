#include "vispline/estimate/imu_measurement.h"

#include <algorithm>

namespace vispline {
namespace {

/// Local columns of everything but the knots.
struct ImuLocal {
  ImuColumns c;
  int gravity_direction, gravity_magnitude;
  int bias_walk = -1;
  std::size_t first_node = 0;

  ImuLocal(const ImuColumns& global, const GravityColumns& gravity, Rows& rows)
      : c{rows.append(global.translation, 3),       rows.append(global.rotation, 3),
          rows.append(global.time_offset, 1),       rows.append(global.gyro_bias, 3),
          rows.append(global.gyro_scale, 3),        rows.append(global.gyro_lower, 3),
          rows.append(global.gyro_upper, 3),        rows.append(global.gyro_g_sensitivity, 9),
          rows.append(global.accel_time_offset, 1), rows.append(global.accel_bias, 3),
          rows.append(global.accel_scale, 3),       rows.append(global.accel_lower, 3),
          rows.append(global.accel_upper, 3)},
        gravity_direction(rows.append(gravity.direction, 2)),
        gravity_magnitude(rows.append(gravity.magnitude, 1)) {}
};

class ImuRows final : public Measurement {
 public:
  ImuRows(std::string name, const ImuBatch& batch) : name_(std::move(name)), batch_(batch) {
    const auto per = [](double sigma) { return sigma > 0.0 ? 1.0 / sigma : 0.0; };
    per_sigma_ << Vector3d::Constant(per(batch.sigma.gyro)), Vector3d::Constant(per(batch.sigma.accel));
  }

  std::vector<std::string> sensors() const override { return {name_ + ".gyroscope", name_ + ".accelerometer"}; }
  std::size_t sensor_of(Eigen::Index row) const override { return row % 6 < 3 ? 0 : 1; }
  SensorScale scale_of(std::size_t sensor) const override {
    return sensor == 0 ? SensorScale{"rad/s", batch_.sigma.gyro} : SensorScale{"m/s^2", batch_.sigma.accel};
  }
  RowOrigin origin_of(Eigen::Index row) const override { return {time(row / 6), static_cast<int>(row % 3)}; }
  Time time() const override { return batch_.time.front(); }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    const Imu& imu = state.rig.imus[batch_.imu];
    const auto samples = static_cast<Eigen::Index>(batch_.time.size());
    rows.start(6 * samples);
    if (!derivatives) {
      for (Eigen::Index i = 0; i < samples; ++i) predict(state, imu, i, rows);
      return;
    }
    const Curve& curve = *state.curve;
    const double early = std::min(imu.gyroscope.time_offset_s, imu.accelerometer.time_offset_s);
    const double late = std::max(imu.gyroscope.time_offset_s, imu.accelerometer.time_offset_s);
    const KnotColumns knots = append_knots(curve, columns.layout, curve.first_knot({batch_.time.front(), early}),
                                           curve.first_knot({batch_.time.back(), late}), rows);
    ImuLocal local(columns.parameters.imus[batch_.imu], columns.parameters.gravity, rows);
    append_bias_walk(state, columns.layout, local, rows);
    rows.allocate_jacobian();
    for (Eigen::Index i = 0; i < samples; ++i) {
      linearize(state, imu, i, knots, local, rows);
    }
  }

 private:
  Time time(Eigen::Index i) const { return batch_.time[static_cast<std::size_t>(i)]; }
  const ImuSample& sample(Eigen::Index i) const { return batch_.sample[static_cast<std::size_t>(i)]; }
  bool together(const Imu& imu) const { return imu.gyroscope.time_offset_s == imu.accelerometer.time_offset_s; }

  Vector6d bias_walk(const State& state, const Instant& at) const {
    return state.bias_walks.empty() ? Vector6d(Vector6d::Zero()) : state.bias_walks[batch_.imu].at(at);
  }

  void append_bias_walk(const State& state, const Layout& layout, ImuLocal& local, Rows& rows) const {
    if (layout.bias.empty() || layout.bias[batch_.imu].empty()) return;
    const BiasWalk& walk = state.bias_walks[batch_.imu];
    const std::size_t last = walk.locate({batch_.time.back()}).first + 1;
    local.first_node = walk.locate({batch_.time.front()}).first;
    for (std::size_t n = local.first_node; n <= last; ++n) {
      const int first = rows.append(layout.bias[batch_.imu][n], 6);
      if (n == local.first_node) local.bias_walk = first;
    }
  }

  void predict(const State& state, const Imu& imu, Eigen::Index i, Rows& rows) const {
    const BodyState gyro_state = state.curve->state({time(i), imu.gyroscope.time_offset_s});
    const BodyState accel_state =
        together(imu) ? gyro_state : state.curve->state({time(i), imu.accelerometer.time_offset_s});
    Vector6d predicted;
    predicted << Gyroscope::predict<double>(gyro_state, imu.gyroscope, state.g_w),
        Accelerometer::predict<double>(accel_state, imu.accelerometer, state.g_w);
    set_residual(i, predicted + bias_walk(state, {time(i)}), rows);
    scale_residual(i, rows);
  }

  void linearize(const State& state, const Imu& imu, Eigen::Index i, const KnotColumns& knots, const ImuLocal& local,
                 Rows& rows) const {
    Vector6d predicted = Vector6d::Zero();
    const auto triads = [&](bool gyro, bool accel, double offset_s) {
      const auto d_state = [&](const BodyState& body, const BodyTangent& rate) {
        BodyJacobian<6> L = BodyJacobian<6>::Zero();
        if (gyro) L.topRows<3>() = per_sigma_(0) * gyroscope(body, rate, state, imu, i, local, predicted, rows);
        if (accel) L.bottomRows<3>() = per_sigma_(3) * accelerometer(body, rate, state, imu, i, local, predicted, rows);
        return L;
      };
      const KnotRows<6> part = state.curve->pull_back({time(i), offset_s}, d_state);
      knots.add(part.J, part.first, 6 * i, rows.J);
    };
    if (together(imu)) {
      triads(true, true, imu.gyroscope.time_offset_s);
    } else {
      triads(true, false, imu.gyroscope.time_offset_s);
      triads(false, true, imu.accelerometer.time_offset_s);
    }
    set_residual(i, predicted + bias_walk(state, {time(i)}), rows);
    scale_residual(i, rows);
    if (local.bias_walk >= 0) {
      const BiasWalk::Place place = state.bias_walks[batch_.imu].locate({time(i)});
      const int node = local.bias_walk + 6 * static_cast<int>(place.first - local.first_node);
      rows.J.block<6, 6>(6 * i, node).diagonal().array() += (1.0 - place.u) * per_sigma_.array();
      rows.J.block<6, 6>(6 * i, node + 6).diagonal().array() += place.u * per_sigma_.array();
    }
  }

  template <class Sensor>
  static auto part(const Linearization<3, Sensor::kParams>& l, std::string_view block) {
    const std::size_t index = block_index(Sensor::kBlocks, block);
    return l.d_params.middleCols(tangent_offset(Sensor::kBlocks, index), Sensor::kBlocks[index].tangent_size());
  }

  /// Columns of one triad, from `row` on, over its sigma.
  struct Put {
    Rows& rows;
    Eigen::Index row;
    double per_sigma;
    template <class Block>
    void operator()(int column, const Block& block) const {
      if (column >= 0) rows.J.block(row, column, 3, block.cols()) = per_sigma * block;
    }
  };

  template <class Sensor>
  static void common(const Linearization<3, Sensor::kParams>& l, const Pose& T_b_i, const State& state,
                     const ImuLocal& local, const Put& put) {
    const auto pose = part<Sensor>(l, "T_b_i");
    if (local.c.translation >= 0) put(local.c.translation, pose.leftCols(3) * T_b_i.R.transpose());
    put(local.c.rotation, pose.rightCols(3));
    put(local.c.time_offset, part<Sensor>(l, "time_offset"));
    if (local.gravity_direction >= 0) {
      put(local.gravity_direction, l.d_g_w * plane_across(state.g_w) * state.g_w.norm());
    }
    if (local.gravity_magnitude >= 0) put(local.gravity_magnitude, l.d_g_w * state.g_w.normalized());
  }

  template <class Sensor>
  static void misalignment(const Linearization<3, Sensor::kParams>& l, int lower, int upper, const Put& put) {
    const auto d = part<Sensor>(l, "misalignment");
    for (int k = 0; k < 3; ++k) {
      if (lower >= 0) put(lower + k, d.col(kLower[static_cast<std::size_t>(k)]));
      if (upper >= 0) put(upper + k, d.col(kUpper[static_cast<std::size_t>(k)]));
    }
  }

  BodyJacobian<3> gyroscope(const BodyState& body, const BodyTangent& rate, const State& state, const Imu& imu,
                            Eigen::Index i, const ImuLocal& local, Vector6d& predicted, Rows& rows) const {
    const auto l = Gyroscope::linearize(body, rate, imu.gyroscope, state.g_w);
    const Put put{rows, 6 * i, per_sigma_(0)};
    predicted.head<3>() = l.prediction;
    common<Gyroscope>(l, imu.gyroscope.T_b_i, state, local, put);
    put(local.c.gyro_bias, part<Gyroscope>(l, "bias"));
    put(local.c.gyro_scale, part<Gyroscope>(l, "scale"));
    misalignment<Gyroscope>(l, local.c.gyro_lower, local.c.gyro_upper, put);
    put(local.c.gyro_g_sensitivity, part<Gyroscope>(l, "g_sensitivity"));
    return l.d_state;
  }

  BodyJacobian<3> accelerometer(const BodyState& body, const BodyTangent& rate, const State& state, const Imu& imu,
                                Eigen::Index i, const ImuLocal& local, Vector6d& predicted, Rows& rows) const {
    const auto l = Accelerometer::linearize(body, rate, imu.accelerometer, state.g_w);
    const Put put{rows, 6 * i + 3, per_sigma_(3)};
    predicted.tail<3>() = l.prediction;
    common<Accelerometer>(l, imu.accelerometer.T_b_i, state, local, put);
    put(local.c.accel_time_offset, part<Accelerometer>(l, "time_offset"));
    put(local.c.accel_bias, part<Accelerometer>(l, "bias"));
    put(local.c.accel_scale, part<Accelerometer>(l, "scale"));
    misalignment<Accelerometer>(l, local.c.accel_lower, local.c.accel_upper, put);
    return l.d_state;
  }

  void set_residual(Eigen::Index i, const Vector6d& predicted, Rows& rows) const {
    rows.r.segment<3>(6 * i) = predicted.head<3>() - sample(i).gyro;
    rows.r.segment<3>(6 * i + 3) = predicted.tail<3>() - sample(i).accel;
  }

  void scale_residual(Eigen::Index i, Rows& rows) const {
    for (int triad = 0; triad < 2; ++triad) {
      auto r = rows.r.segment<3>(6 * i + 3 * triad);
      r *= per_sigma_(3 * triad);
      const double s = r.squaredNorm();
      rows.cost += 0.5 * batch_.loss.loss(s);
      rows.weight.segment<3>(6 * i + 3 * triad).setConstant(batch_.loss.weight(s));
    }
  }

  std::string name_;
  ImuBatch batch_;
  Vector6d per_sigma_;  ///< zero: not used
};

}  // namespace

std::unique_ptr<Measurement> imu_measurement(const State& state, const ImuBatch& batch) {
  return std::make_unique<ImuRows>(state.rig.imus[batch.imu].name, batch);
}

}  // namespace vispline
