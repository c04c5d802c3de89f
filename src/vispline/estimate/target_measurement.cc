#include "vispline/estimate/target_measurement.h"

#include <algorithm>

#include "vispline/estimate/reprojection.h"

namespace vispline {
namespace {

struct CameraLocal {
  int translation, rotation, intrinsics, time_offset, line_delay;
  CameraLocal(const CameraColumns& global, int lens, Rows& rows)
      : translation(rows.append(global.translation, 3)),
        rotation(rows.append(global.rotation, 3)),
        intrinsics(rows.append(global.intrinsics, lens)),
        time_offset(rows.append(global.time_offset, 1)),
        line_delay(rows.append(global.line_delay, 1)) {}
};

class TargetRows final : public Measurement {
 public:
  TargetRows(std::string name, TargetFrame frame)
      : name_(std::move(name)), frame_(std::move(frame)), whitening_(frame_.px.size(), Eigen::Matrix2d::Identity()) {}

  std::vector<std::string> sensors() const override { return {name_}; }
  SensorScale scale_of(std::size_t /*sensor*/) const override { return {"px", frame_.sigma_px}; }
  RowOrigin origin_of(Eigen::Index row) const override {
    return {frame_.stamp, static_cast<int>(row % 2), px(row / 2)};
  }
  Time time() const override { return frame_.stamp; }

  void whiten(const State& state) override {
    const Camera& camera = state.rig.cameras[frame_.camera];
    if (is_global(camera)) return;
    for (std::size_t i = 0; i < frame_.px.size(); ++i) {
      const PoseSample at = state.curve->sample({frame_.stamp, camera.delay_s(frame_.px[i])}, false);
      whitening_[i] = line_whitening(camera, at.T_w_b, at.twist_b, HomogeneousPoint::known(frame_.point[i]));
    }
  }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    const Camera& camera = state.rig.cameras[frame_.camera];
    const CameraColumns& global = columns.parameters.cameras[frame_.camera];
    rows.start(2 * points());
    if (!derivatives) {
      predict(state, rows);
      return;
    }
    const KnotColumns knots = append(state, camera, columns, rows);
    const CameraLocal local(global, static_cast<int>(camera.lens.params.size()), rows);
    if (is_global(camera) && global.line_delay < 0) {
      linearize_global(state, knots, local, rows);
    } else {
      linearize_rolling(state, knots, local, rows);
    }
  }

 private:
  static bool is_global(const Camera& camera) { return camera.shutter.line_delay_s == 0.0; }
  Eigen::Index points() const { return static_cast<Eigen::Index>(frame_.px.size()); }
  const Vector2d& px(Eigen::Index i) const { return frame_.px[static_cast<std::size_t>(i)]; }

  KnotColumns append(const State& state, const Camera& camera, const Columns& columns, Rows& rows) const {
    std::size_t first = state.curve->knots(), last = 0;
    for (const Vector2d& z : frame_.px) {
      const std::size_t k = state.curve->first_knot({frame_.stamp, camera.delay_s(z)});
      first = std::min(first, k);
      last = std::max(last, k);
    }
    return append_knots(*state.curve, columns.layout, first, last, rows);
  }

  HomogeneousPoint known(Eigen::Index i) const {
    return HomogeneousPoint::known(frame_.point[static_cast<std::size_t>(i)]);
  }
  Eigen::Matrix2d scale(Eigen::Index i) const { return *whitening_[static_cast<std::size_t>(i)] / frame_.sigma_px; }

  /// Residual, weight and cost of point i; false if it is lost.
  bool measure(Eigen::Index i, const std::optional<Vector2d>& seen_px, Rows& rows) const {
    if (!seen_px || !whitening_[static_cast<std::size_t>(i)]) {
      ++rows.lost;
      rows.cost += 0.5 * frame_.loss.loss(kLostSigmas * kLostSigmas);
      rows.weight.segment<2>(2 * i).setZero();
      return false;
    }
    const Vector2d r = scale(i) * (*seen_px - px(i));
    rows.r.segment<2>(2 * i) = r;
    rows.cost += 0.5 * frame_.loss.loss(r.squaredNorm());
    rows.weight.segment<2>(2 * i).setConstant(frame_.loss.weight(r.squaredNorm()));
    return true;
  }

  void predict(const State& state, Rows& rows) const {
    const Camera& camera = state.rig.cameras[frame_.camera];
    Pose T_w_b;
    for (Eigen::Index i = 0; i < points(); ++i) {
      if (i == 0 || !is_global(camera)) T_w_b = state.curve->pose({frame_.stamp, camera.delay_s(px(i))});
      measure(i, reproject(camera, T_w_b, known(i)), rows);
    }
  }

  void linearize_global(const State& state, const KnotColumns& knots, const CameraLocal& local, Rows& rows) const {
    const Camera& camera = state.rig.cameras[frame_.camera];
    const PoseSample at = state.curve->sample({frame_.stamp, camera.time_offset_s}, true);
    start_chain(camera, at, knots, local, rows);
    for (Eigen::Index i = 0; i < points(); ++i) {
      const auto seen = linearize_reprojection(camera, at.T_w_b, known(i));
      if (!measure(i, px_of(seen), rows)) continue;
      rows.J.block<2, 6>(2 * i, 0) = scale(i) * seen->d_pose;
      if (local.intrinsics >= 0) rows.J.middleRows<2>(2 * i).rightCols(seen->d_lens.cols()) = scale(i) * seen->d_lens;
    }
  }

  void linearize_rolling(const State& state, const KnotColumns& knots, const CameraLocal& local, Rows& rows) const {
    const Camera& camera = state.rig.cameras[frame_.camera];
    rows.allocate_jacobian();
    for (Eigen::Index i = 0; i < points(); ++i) {
      const PoseSample at = state.curve->sample({frame_.stamp, camera.delay_s(px(i))}, true);
      const auto seen = linearize_reprojection(camera, at.T_w_b, known(i));
      if (measure(i, px_of(seen), rows)) differentiate(camera, at, i, *seen, knots, local, rows);
    }
  }

  static std::optional<Vector2d> px_of(const std::optional<Reprojection>& seen) {
    return seen ? std::optional(seen->px) : std::nullopt;
  }

  /// All points of a global shutter are seen from one pose: rows of J are by its six numbers and by the lens; knots,
  /// clock and T_c_b only move that pose.
  static void start_chain(const Camera& camera, const PoseSample& at, const KnotColumns& knots,
                          const CameraLocal& local, Rows& rows) {
    const Eigen::Index lens = local.intrinsics >= 0 ? camera.lens.params.size() : 0;
    rows.J.setZero(rows.r.size(), 6 + lens);
    rows.chain.setZero(6 + lens, static_cast<Eigen::Index>(rows.column.size()));
    knots.add(at.d_knots.J, at.d_knots.first, 0, rows.chain);
    if (local.translation >= 0) rows.chain.block<3, 3>(0, local.translation) = -camera.T_c_b.R.transpose();
    if (local.rotation >= 0) rows.chain.block<3, 3>(3, local.rotation) = -Matrix3d::Identity();
    if (local.time_offset >= 0) rows.chain.block<6, 1>(0, local.time_offset) = at.twist_b;
    if (lens > 0) rows.chain.block(6, local.intrinsics, lens, lens).setIdentity();
  }

  void differentiate(const Camera& camera, const PoseSample& at, Eigen::Index i, const Reprojection& seen,
                     const KnotColumns& knots, const CameraLocal& local, Rows& rows) const {
    const Vector2d ydot = seen.d_pose * at.twist_b;
    const Matrix2x6 d_pose = scale(i) * seen.d_pose;
    knots.add((d_pose * at.d_knots).J, at.d_knots.first, 2 * i, rows.J);
    const auto put = [&](int column, const auto& block) {
      if (column >= 0) rows.J.block(2 * i, column, 2, block.cols()) = scale(i) * block;
    };
    put(local.translation, seen.d_T_c_b.leftCols<3>());
    put(local.rotation, seen.d_T_c_b.rightCols<3>());
    put(local.intrinsics, seen.d_lens);
    put(local.time_offset, ydot);
    put(local.line_delay, (camera.shutter.line(px(i), camera.resolution_px) * ydot).eval());
  }

  std::string name_;
  TargetFrame frame_;
  std::vector<std::optional<Eigen::Matrix2d>> whitening_;  ///< empty: not to be predicted
};

}  // namespace

std::unique_ptr<Measurement> target_measurement(const State& state, TargetFrame frame) {
  return std::make_unique<TargetRows>(state.rig.cameras[frame.camera].name, std::move(frame));
}

}  // namespace vispline
