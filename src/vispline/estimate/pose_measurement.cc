#include "vispline/estimate/pose_measurement.h"

#include "vispline/core/so3.h"

namespace vispline {
namespace {

constexpr double kGaugeSigma = 1e-3;  // m and rad; any value gives the same estimate

class PoseRows final : public Measurement {
 public:
  PoseRows(std::string name, const PoseBatch& batch) : name_(std::move(name)), batch_(batch) {}

  std::vector<std::string> sensors() const override { return {name_ + ".position", name_ + ".rotation"}; }
  std::size_t sensor_of(Eigen::Index row) const override { return row % 6 < 3 ? 0 : 1; }
  SensorScale scale_of(std::size_t sensor) const override {
    return sensor == 0 ? SensorScale{"m", batch_.position_sigma_m} : SensorScale{"rad", batch_.rotation_sigma_rad};
  }
  RowOrigin origin_of(Eigen::Index row) const override {
    return {batch_.time[static_cast<std::size_t>(row / 6)], static_cast<int>(row % 3)};
  }
  Time time() const override { return batch_.time.front(); }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    const PoseReference& reference = state.references[batch_.reference];
    rows.start(6 * static_cast<Eigen::Index>(batch_.time.size()));
    KnotColumns knots;
    ReferenceColumns local;
    if (derivatives) {
      const Curve& curve = *state.curve;
      knots = append_knots(curve, columns.layout, curve.first_knot({batch_.time.front(), reference.time_offset_s}),
                           curve.first_knot({batch_.time.back(), reference.time_offset_s}), rows);
      const ReferenceColumns& global = columns.parameters.references[batch_.reference];
      local = {rows.append(global.world_translation, 3), rows.append(global.world_rotation, 3),
               rows.append(global.translation, 3), rows.append(global.rotation, 3), rows.append(global.time_offset, 1)};
      rows.allocate_jacobian();
    }
    for (std::size_t i = 0; i < batch_.time.size(); ++i) {
      const PoseSample at = state.curve->sample({batch_.time[i], reference.time_offset_s}, derivatives);
      pose(reference, at, i, derivatives, knots, local, rows);
    }
  }

 private:
  void pose(const PoseReference& reference, const PoseSample& at, std::size_t i, bool derivatives,
            const KnotColumns& knots, const ReferenceColumns& local, Rows& rows) const {
    const auto row = static_cast<Eigen::Index>(6 * i);
    const Pose T_m_b = reference.T_m_w * at.T_w_b, T_m_k = T_m_b * reference.T_b_k;
    const Vector3d turn = SO3::log<double>(Matrix3d(batch_.T_m_k[i].R.transpose() * T_m_k.R));
    residual(row, T_m_k.p - batch_.T_m_k[i].p, batch_.position_sigma_m, rows);
    residual(row + 3, turn, batch_.rotation_sigma_rad, rows);
    if (!derivatives) return;
    const Matrix3d Jr_inv = SO3::left_jacobian_inverse<double>(Vector3d(-turn));
    const Matrix3d R_k_b = reference.T_b_k.R.transpose();
    Matrix6d d_pose = Matrix6d::Zero();
    d_pose.topLeftCorner<3, 3>() = T_m_b.R;
    d_pose.topRightCorner<3, 3>() = -T_m_b.R * hat(reference.T_b_k.p);
    d_pose.bottomRightCorner<3, 3>() = Jr_inv * R_k_b;
    const auto put = [&](int column, const auto& position, const auto& rotation) {
      if (column < 0) return;
      rows.J.block(row, column, 3, position.cols()) = position;
      rows.J.block(row + 3, column, 3, rotation.cols()) = rotation;
    };
    knots.add((d_pose * at.d_knots).J, at.d_knots.first, row, rows.J);
    put(local.world_translation, Matrix3d::Identity(), Matrix3d::Zero());
    put(local.world_rotation, (-reference.T_m_w.R * hat<double>(at.T_w_b * reference.T_b_k.p)).eval(),
        (Jr_inv * R_k_b * at.T_w_b.R.transpose()).eval());
    put(local.translation, T_m_b.R, Matrix3d::Zero());
    put(local.rotation, Matrix3d::Zero(), Jr_inv);
    const Vector6d rate = d_pose * at.twist_b;
    put(local.time_offset, rate.head<3>(), rate.tail<3>());
    scale(row, batch_.position_sigma_m, rows);
    scale(row + 3, batch_.rotation_sigma_rad, rows);
  }

  void residual(Eigen::Index row, const Vector3d& r, double sigma, Rows& rows) const {
    if (sigma <= 0.0) return;
    rows.r.segment<3>(row) = r / sigma;
    const double s = r.squaredNorm() / (sigma * sigma);
    rows.cost += 0.5 * batch_.loss.loss(s);
    rows.weight.segment<3>(row).setConstant(batch_.loss.weight(s));
  }

  static void scale(Eigen::Index row, double sigma, Rows& rows) {
    rows.J.middleRows<3>(row) *= sigma > 0.0 ? 1.0 / sigma : 0.0;
  }

  std::string name_;
  PoseBatch batch_;
};

class GaugeRows final : public Measurement {
 public:
  explicit GaugeRows(const Gauge& gauge) : gauge_(gauge) {}

  std::vector<std::string> sensors() const override { return {"gauge"}; }
  bool only_holds() const override { return true; }
  Time time() const override { return gauge_.time; }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    const PoseSample at = state.curve->sample({gauge_.time}, derivatives);
    // Rotation error in w: the vertical component alone is what a yaw changes.
    const Vector3d turn_w = SO3::log<double>(Matrix3d(at.T_w_b.R * gauge_.T_w_b.R.transpose()));
    const Eigen::Matrix<double, Eigen::Dynamic, 3> about = gauge_.whole_rotation
                                                               ? Eigen::MatrixXd(Matrix3d::Identity())
                                                               : Eigen::MatrixXd(state.g_w.normalized().transpose());
    rows.start(3 + about.rows());
    rows.r << (at.T_w_b.p - gauge_.T_w_b.p) / kGaugeSigma, about * turn_w / kGaugeSigma;
    rows.cost = 0.5 * rows.r.squaredNorm();
    if (!derivatives) return;
    const KnotColumns knots = append_knots(*state.curve, columns.layout, at.d_knots.first, at.d_knots.first, rows);
    rows.allocate_jacobian();
    Eigen::MatrixXd d_pose = Eigen::MatrixXd::Zero(rows.r.size(), 6);
    d_pose.topLeftCorner<3, 3>() = at.T_w_b.R;
    d_pose.bottomRightCorner(about.rows(), 3) = about * SO3::left_jacobian_inverse<double>(turn_w) * at.T_w_b.R;
    knots.add((d_pose * at.d_knots.J / kGaugeSigma).eval(), at.d_knots.first, 0, rows.J);
  }

 private:
  Gauge gauge_;
};

}  // namespace

std::unique_ptr<Measurement> pose_measurement(const State& /*state*/, const PoseBatch& batch) {
  return std::make_unique<PoseRows>("reference" + std::to_string(batch.reference), batch);
}

std::unique_ptr<Measurement> gauge_measurement(const Gauge& gauge) { return std::make_unique<GaugeRows>(gauge); }

}  // namespace vispline
