#include "vispline/estimate/track.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "vispline/estimate/track_kernel.h"

namespace vispline {
namespace {

using namespace track_kernel;

class TrackLinearizer {
 public:
  TrackLinearizer(const State& state, const Columns& columns, const TrackModel& model, const Track& track,
                  Skyline& system, Eigen::VectorXd& gradient)
      : state_(state),
        model_(model),
        track_(track),
        system_(system),
        gradient_(gradient),
        columns_(state, columns, track),
        reference_(reference_of(state, track, true)),
        n_(model.size()) {
    block_.column = columns_.column();
    C_.setZero(4, static_cast<Eigen::Index>(block_.column.size()));
  }

  TrackBlock run() {
    for (std::size_t i = 1; i < track_.sightings.size(); ++i) sighting(i);
    const Sparse<Matrix4X> Q = reference_columns(reference_, model_, columns_);
    const LandmarkRows Q_l = landmark_columns(reference_.anchor, model_, landmark().bearing_c);
    block_.W = Q_l.transpose().lazyProduct(C_);
    block_.H.topLeftCorner(n_, n_) = Q_l.transpose() * S_ * Q_l;
    block_.g.head(n_) = Q_l.transpose() * s_;
    const bool point = model_.unknowns == LandmarkUnknowns::kPoint, held = wants_beyond_infinity();
    point && !held ? carry(Q, Q_l) : along_with_reference(Q, Q_l);
    if (point) reference_pixel(Q);
    if (held) hold_at_infinity();
    return std::move(block_);
  }

 private:
  const InverseDepthLandmark& landmark() const { return state_.landmarks[track_.landmark]; }

  void lose() {
    ++block_.lost;
    block_.cost += lost_cost(model_);
  }

  /// Rows A with residual r, by their local columns: their products go to the system.
  void add(const Sparse<Matrix2X>& A, const Vector2d& r) {
    A_t_ = A.J.transpose();
    global_ = global_columns(A.local, block_.column);
    system_.add_rows(global_, A_t_);
    add_to(global_, A_t_ * r, gradient_);
  }

  /// The sighting's own columns at once; what it says of the point is collected in C, S and s.
  void sighting(std::size_t index) {
    const Sighting& s = track_.sightings[index];
    const Camera& camera = state_.rig.cameras[s.camera];
    const PoseSample at = state_.curve->pose({s.stamp, camera.delay_s(s.px)}, true);
    const auto seen = see(state_, model_, track_, index, at, reference_.anchor.point);
    if (!seen) return lose();
    block_.cost += 0.5 * model_.loss.loss(seen->r.squaredNorm());
    const Sparse<Matrix2X> A = sighting_columns(camera, s, at, *seen, columns_);
    const Eigen::Matrix<double, 2, 4> q = seen->root * seen->scale * seen->image.d_point;
    const Vector2d r = seen->root * seen->r;
    add(A, r);
    for (std::size_t i = 0; i < A.local.size(); ++i) {
      C_.col(A.local[i]) += q.transpose() * A.J.col(static_cast<Eigen::Index>(i));
    }
    S_ += q.transpose() * q;
    s_ += q.transpose() * r;
  }

  /// The point itself depends on the reference view and on the landmark.
  void along_with_reference(const Sparse<Matrix4X>& Q, const LandmarkRows& Q_l) {
    const std::vector<int> global = global_columns(Q.local, block_.column);
    system_.add(global, Q.J.transpose() * S_ * Q.J);
    add_to(global, Q.J.transpose() * s_, gradient_);
    const Eigen::MatrixXd C_t = C_.transpose(), Q_t = Q.J.transpose();
    system_.add_products(block_.column, C_t, global, Q_t);
    const Eigen::MatrixXd W = Q_l.transpose() * S_ * Q.J;
    for (std::size_t i = 0; i < Q.local.size(); ++i) {
      block_.W.col(Q.local[i]) += W.col(static_cast<Eigen::Index>(i));
    }
  }

  /// A point has its own three unknowns, and the reference view moves it as these could: Q = Q_l carry, up to a
  /// multiple of the homogeneous point, which no image sees. Counted in the world, the point does not depend on that
  /// view.
  void carry(const Sparse<Matrix4X>& Q, const LandmarkRows& Q_l) {
    const HomogeneousPoint& point = reference_.anchor.point;
    Eigen::Matrix4d basis;
    basis << Q_l, (Eigen::Vector4d() << point.direction_w, point.inverse_distance).finished();
    block_.carry = (basis.inverse() * Q.J).topRows<3>();
    block_.carried = global_columns(Q.local, block_.column);
  }

  /// Only the bearing and the lens move it; the bearing is the point in the world less what the view carries.
  void reference_pixel(const Sparse<Matrix4X>& Q) {
    const auto rows = reference_rows(state_, model_, track_, reference_);
    if (!rows) return lose();
    block_.cost += 0.5 * model_.loss.loss(rows->r.squaredNorm());
    const Eigen::Matrix2d scale = rows->root * rows->scale;
    const Vector2d r = rows->root * rows->r;
    const Eigen::Matrix2d J_l = scale * rows->image.d_point * plane_across(landmark().bearing_c);
    Sparse<Matrix2X> A;
    if (!block_.carried.empty()) A = {Q.local, -J_l * block_.carry.topRows<2>()};
    A.append(columns_.camera(reference_.sighting->camera).intrinsics, (scale * rows->image.d_params).eval());
    add(A, r);
    for (std::size_t i = 0; i < A.local.size(); ++i) {
      block_.W.col(A.local[i]).head<2>() += J_l.transpose() * A.J.col(static_cast<Eigen::Index>(i));
    }
    block_.H.topLeftCorner<2, 2>() += J_l.transpose() * J_l;
    block_.g.head<2>() += J_l.transpose() * r;
  }

  bool wants_beyond_infinity() const { return landmark().inverse_distance <= 0.0 && block_.g(n_ - 1) > 0.0; }

  /// A point at infinity that wants to go beyond stays there: its inverse distance is no unknown of this step.
  void hold_at_infinity() {
    const Eigen::Index rho = n_ - 1;
    block_.W.row(rho).setZero();
    block_.H.row(rho).setZero();
    block_.H.col(rho).setZero();
    block_.H(rho, rho) = 1.0;
    block_.g(rho) = 0.0;
  }

  const State& state_;
  const TrackModel& model_;
  const Track& track_;
  Skyline& system_;
  Eigen::VectorXd& gradient_;
  TrackColumns columns_;
  Reference reference_;
  Eigen::Index n_;
  TrackBlock block_;
  Eigen::Matrix<double, 4, Eigen::Dynamic> C_;
  std::vector<int> global_;  ///< with A_t_, room for rows
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, kMostColumns, 2> A_t_;
  Eigen::Matrix4d S_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d s_ = Eigen::Vector4d::Zero();
};

}  // namespace

void whiten(const State& state, Track& track) {
  const HomogeneousPoint point = reference_of(state, track, false).anchor.point;
  track.whitening.resize(track.sightings.size());
  for (std::size_t i = 0; i < track.sightings.size(); ++i) {
    const Sighting& s = track.sightings[i];
    const Camera& camera = state.rig.cameras[s.camera];
    const PoseSample at = state.curve->pose({s.stamp, camera.delay_s(s.px)}, false);
    track.whitening[i] = line_whitening(camera, at.T_w_b, at.twist_b, point);
  }
}

TrackResiduals evaluate_track(const State& state, const TrackModel& model, const Track& track) {
  const Reference reference = reference_of(state, track, false);
  TrackResiduals out;
  out.r.assign(track.sightings.size(), Vector2d::Zero());
  const auto take = [&](std::size_t i, const Vector2d& r) {
    out.r[i] = r;
    out.cost += 0.5 * model.loss.loss(r.squaredNorm());
  };
  const auto lose = [&] {
    ++out.lost;
    out.cost += lost_cost(model);
  };
  for (std::size_t i = 1; i < track.sightings.size(); ++i) {
    const Sighting& s = track.sightings[i];
    const Camera& camera = state.rig.cameras[s.camera];
    const PoseSample at = state.curve->pose({s.stamp, camera.delay_s(s.px)}, false);
    const auto seen = see(state, model, track, i, at, reference.anchor.point);
    seen ? take(i, seen->r) : lose();
  }
  if (model.unknowns == LandmarkUnknowns::kPoint) {
    const auto rows = reference_rows(state, model, track, reference);
    rows ? take(0, rows->r) : lose();
  }
  return out;
}

std::vector<int> columns_of(const State& state, const Columns& columns, const Track& track) {
  return TrackColumns(state, columns, track).column();
}

TrackBlock linearize_track(const State& state, const Columns& columns, const TrackModel& model, const Track& track,
                           Skyline& system, Eigen::VectorXd& gradient) {
  return TrackLinearizer(state, columns, model, track, system, gradient).run();
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
