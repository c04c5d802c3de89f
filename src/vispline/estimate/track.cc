#include "vispline/estimate/track.h"

#include <Eigen/LU>
#include <algorithm>

#include "vispline/estimate/track_columns.h"
#include "vispline/estimate/track_kernel.h"
#include "vispline/estimate/view_sums.h"

namespace vispline {
namespace {

using namespace track_kernel;

class TrackLinearizer {
 public:
  TrackLinearizer(const State& state, const Columns& columns, const TrackColumns& local, const TrackModel& model,
                  const Track& track, Weights weights, ViewSums& views)
      : state_(state),
        cameras_(columns.parameters.cameras),
        local_(local),
        model_(model),
        track_(track),
        weights_(weights),
        views_(views),
        reference_(reference_of(state, track, true)),
        n_(model.size()),
        C_(Eigen::MatrixXd::Zero(local.size(), 4)) {
    block_.column = local.column();
    block_.g.setZero(local.size());
    block_.whitening.assign(track.sightings.size(), Eigen::Matrix2d(Eigen::Matrix2d::Identity()));
  }

  TrackBlock run() {
    for (std::size_t i = 1; i < track_.sightings.size(); ++i) sighting(i);
    const ViewRows<4> Q = rows_of(reference_, model_, camera(0));
    const LandmarkRows Q_l = landmark_columns(reference_.anchor, model_, landmark().bearing_c);
    block_.W_t = C_.lazyProduct(Q_l);
    block_.H_l.topLeftCorner(n_, n_) = Q_l.transpose() * S_ * Q_l;
    block_.g_l.head(n_) = Q_l.transpose() * s_;
    block_.reference = local_.columns_of(0);
    const bool point = model_.unknowns == LandmarkUnknowns::kPoint, held = wants_beyond_infinity();
    point && !held ? carry(Q, Q_l) : along_with_reference(Q, Q_l);
    if (point) reference_row(Q.size, Q.knots);
    if (held) hold_at_infinity();
    return std::move(block_);
  }

 private:
  const InverseDepthLandmark& landmark() const { return state_.landmarks[track_.landmark]; }
  const CameraColumns& camera(std::size_t i) const { return cameras_[track_.sightings[i].camera]; }

  const std::optional<Eigen::Matrix2d>* if_kept(const std::optional<Eigen::Matrix2d>& whitening) const {
    return weights_ == Weights::kKept ? &whitening : nullptr;
  }

  void lose(std::size_t i) {
    ++block_.lost;
    block_.cost += lost_cost(model_);
    block_.whitening[i] = std::nullopt;
  }
  void take(std::size_t i, const Seen& seen) {
    block_.cost += 0.5 * model_.loss.loss(seen.r.squaredNorm());
    block_.whitening[i] = seen.whitening;
  }

  /// The sighting's own columns at once; what it says of the point is collected in C, S and s.
  void sighting(std::size_t i) {
    const Sighting& s = track_.sightings[i];
    const std::optional<Eigen::Matrix2d> kept = whitening_of(track_, i);
    const auto [seen, d_knots] = see(state_, model_, s, reference_.anchor.point, if_kept(kept));
    if (!seen) return lose(i);
    take(i, *seen);
    const ViewRows<2> A = rows_of(state_, camera(i), s, *seen, d_knots);
    const Eigen::Matrix<double, 2, 4> q = seen->root * seen->scale * seen->image.d_point;
    const Vector2d r = seen->root * seen->r;
    views_.add(s.camera, local_.first_knot(i), A, A);
    local_.add(i, A, r, block_.g);
    local_.add(i, A, q, C_);
    S_ += q.transpose() * q;
    s_ += q.transpose() * r;
  }

  /// The point itself depends on the reference view and on the landmark.
  void along_with_reference(const ViewRows<4>& Q, const LandmarkRows& Q_l) {
    ViewRows<4> QS = Q;
    QS.storage.topRows(Q.size) = Q.J_t() * S_;
    views_.add(track_.sightings.front().camera, local_.first_knot(0), QS, Q);
    local_.add(0, Q, s_, block_.g);
    local_.add(0, QS, Q_l, block_.W_t);
    block_.C = C_;
    block_.Q = Q.J_t();
  }

  /// A point has its own three unknowns, and the reference view moves it as these could: Q = Q_l carry, up to a
  /// multiple of the homogeneous point, which no image sees. Counted in the world, the point does not depend on that
  /// view.
  void carry(const ViewRows<4>& Q, const LandmarkRows& Q_l) {
    const HomogeneousPoint& point = reference_.anchor.point;
    Eigen::Matrix4d basis;
    basis << Q_l, (Eigen::Vector4d() << point.direction_w, point.inverse_distance).finished();
    block_.carry_t = Q.J_t() * basis.inverse().transpose().leftCols<3>();
  }

  /// Only the bearing and the lens move it; the bearing is the point in the world less what the view carries.
  void reference_row(Eigen::Index columns, Eigen::Index knots) {
    const std::optional<Eigen::Matrix2d> kept = whitening_of(track_, 0);
    const auto pixel = reference_pixel(state_, model_, track_, reference_, if_kept(kept));
    if (!pixel) return lose(0);
    take(0, pixel->seen);
    const Eigen::Matrix2d scale = pixel->seen.root * pixel->seen.scale;
    const Vector2d r = pixel->seen.root * pixel->seen.r;
    const Eigen::Matrix2d J_l = scale * pixel->d_bearing * plane_across(landmark().bearing_c);
    ViewRows<2> A;
    A.start(knots, columns);
    if (block_.carry_t.size() > 0) A.storage.topRows(columns) = -block_.carry_t.leftCols<2>() * J_l.transpose();
    if (camera(0).intrinsics >= 0) {
      A.storage.middleRows(knots + intrinsics_after(camera(0)), pixel->d_lens.cols()) +=
          (scale.lazyProduct(pixel->d_lens)).transpose();
    }
    views_.add(track_.sightings.front().camera, local_.first_knot(0), A, A);
    local_.add(0, A, r, block_.g);
    auto W_t = block_.W_t.leftCols<2>();
    local_.add(0, A, J_l, W_t);
    block_.H_l.topLeftCorner<2, 2>() += J_l.transpose() * J_l;
    block_.g_l.head<2>() += J_l.transpose() * r;
  }

  bool wants_beyond_infinity() const { return landmark().inverse_distance <= 0.0 && block_.g_l(n_ - 1) > 0.0; }

  /// A point at infinity that wants to go beyond stays there: its inverse distance is no unknown of this step.
  void hold_at_infinity() {
    const Eigen::Index rho = n_ - 1;
    block_.W_t.col(rho).setZero();
    block_.H_l.row(rho).setZero();
    block_.H_l.col(rho).setZero();
    block_.H_l(rho, rho) = 1.0;
    block_.g_l(rho) = 0.0;
  }

  const State& state_;
  const std::vector<CameraColumns>& cameras_;
  const TrackColumns& local_;
  const TrackModel& model_;
  const Track& track_;
  Weights weights_;
  ViewSums& views_;
  Reference reference_;
  Eigen::Index n_;
  TrackBlock block_;
  Eigen::Matrix<double, Eigen::Dynamic, 4> C_;
  Eigen::Matrix4d S_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d s_ = Eigen::Vector4d::Zero();
};

}  // namespace

void whiten(const State& state, Track& track) {
  const HomogeneousPoint point = reference_of(state, track, false).anchor.point;
  track.whitening.resize(track.sightings.size());
  for (std::size_t i = 0; i < track.sightings.size(); ++i) {
    const Sighting& s = track.sightings[i];
    const PoseSample at = state.curve->sample(instant_of(state, s), false);
    track.whitening[i] = line_whitening(state.rig.cameras[s.camera], at.T_w_b, at.twist_b, point);
  }
}

TrackResiduals evaluate_track(const State& state, const TrackModel& model, const Track& track) {
  const Sighting& reference = track.sightings.front();
  const HomogeneousPoint point =
      anchored_point(state.rig.cameras[reference.camera], state.curve->pose(instant_of(state, reference)),
                     state.landmarks[track.landmark]);
  TrackResiduals out;
  out.r.assign(track.sightings.size(), Vector2d::Zero());
  for (std::size_t i = model.unknowns == LandmarkUnknowns::kPoint ? 0 : 1; i < track.sightings.size(); ++i) {
    const Sighting& s = track.sightings[i];
    const auto whitening = whitening_of(track, i);
    const auto px = whitening ? reproject(state.rig.cameras[s.camera], state.curve->pose(instant_of(state, s)), point)
                              : std::nullopt;
    if (px) out.r[i] = *whitening * (*px - s.px) / model.sigma_px[s.camera];
    if (!px) ++out.lost;
    out.cost += px ? 0.5 * model.loss.loss(out.r[i].squaredNorm()) : lost_cost(model);
  }
  return out;
}

TrackBlock linearize_track(const State& state, const Columns& columns, const TrackColumns& local,
                           const TrackModel& model, const Track& track, Weights weights, ViewSums& views) {
  return TrackLinearizer(state, columns, local, model, track, weights, views).run();
}

InverseDepthLandmark moved(const InverseDepthLandmark& landmark, const TrackModel& model, const Vector3d& delta) {
  InverseDepthLandmark next = landmark;
  if (model.unknowns == LandmarkUnknowns::kPoint) {
    next.bearing_c = (landmark.bearing_c + plane_across(landmark.bearing_c) * delta.head<2>()).normalized();
  }
  next.inverse_distance = std::max(0.0, landmark.inverse_distance + delta(model.size() - 1));
  return next;
}

}  // namespace vispline
