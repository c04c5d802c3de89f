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
    if (camera.shutter.line_delay_s == 0.0) return;
    for (std::size_t i = 0; i < frame_.px.size(); ++i) {
      const PoseSample at = state.curve->pose({frame_.stamp, camera.delay_s(frame_.px[i])}, false);
      whitening_[i] = line_whitening(camera, at.T_w_b, at.twist_b, HomogeneousPoint::known(frame_.point[i]));
    }
  }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    const Camera& camera = state.rig.cameras[frame_.camera];
    const auto points = static_cast<Eigen::Index>(frame_.px.size());
    rows.start(2 * points);
    const bool global_shutter =
        camera.shutter.line_delay_s == 0.0 && columns.parameters.cameras[frame_.camera].line_delay < 0;
    const KnotColumns knots = derivatives ? append(state, camera, columns, rows) : KnotColumns{};
    const CameraLocal local(derivatives ? columns.parameters.cameras[frame_.camera] : CameraColumns{},
                            static_cast<int>(camera.lens.params.size()), rows);
    if (derivatives) rows.allocate_jacobian();
    PoseSample at;
    for (Eigen::Index i = 0; i < points; ++i) {
      if (i == 0 || !global_shutter) {
        at = state.curve->pose({frame_.stamp, camera.delay_s(px(i))}, derivatives);
      }
      point(camera, at, i, derivatives, knots, local, rows);
    }
  }

 private:
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

  void point(const Camera& camera, const PoseSample& at, Eigen::Index i, bool derivatives, const KnotColumns& knots,
             const CameraLocal& local, Rows& rows) const {
    const auto seen =
        linearize_reprojection(camera, at.T_w_b, HomogeneousPoint::known(frame_.point[static_cast<std::size_t>(i)]));
    const auto& M = whitening_[static_cast<std::size_t>(i)];
    if (!seen || !M) {
      ++rows.lost;
      rows.cost += 0.5 * frame_.loss.loss(kLostSigmas * kLostSigmas);
      rows.weight.segment<2>(2 * i).setZero();
      return;
    }
    const Eigen::Matrix2d scale = *M / frame_.sigma_px;
    const Vector2d r = scale * (seen->px - px(i));
    rows.r.segment<2>(2 * i) = r;
    rows.cost += 0.5 * frame_.loss.loss(r.squaredNorm());
    rows.weight.segment<2>(2 * i).setConstant(frame_.loss.weight(r.squaredNorm()));
    if (!derivatives) return;
    const Vector2d ydot = seen->d_pose * at.twist_b;
    const Matrix2x6 d_pose = scale * seen->d_pose;
    knots.add((d_pose * at.d_knots.J).eval(), at.d_knots.first, 2 * i, rows.J);
    const auto put = [&](int column, const auto& block) {
      if (column >= 0) rows.J.block(2 * i, column, 2, block.cols()) = scale * block;
    };
    put(local.translation, seen->d_T_c_b.leftCols<3>());
    put(local.rotation, seen->d_T_c_b.rightCols<3>());
    put(local.intrinsics, seen->d_lens);
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
