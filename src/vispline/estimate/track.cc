#include "vispline/estimate/track.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "vispline/estimate/plane_across.h"
#include "vispline/estimate/reprojection.h"

namespace vispline {
namespace {

constexpr int kMostColumns = 6 * kMaxOrder + 8 + kMaxLensParams;
using Matrix2X = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMostColumns>;
using Matrix4X = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, kMostColumns>;

/// Which columns a track has: those of its knots in order, then those of its cameras.
class TrackColumns {
 public:
  TrackColumns(const State& state, const Columns& columns, const Track& track) {
    std::vector<std::size_t> firsts;
    for (const Sighting& s : track.sightings) {
      firsts.push_back(state.curve->first_knot({s.stamp, state.rig.cameras[s.camera].delay_s(s.px)}));
    }
    const auto order = static_cast<std::size_t>(state.curve->order());
    for (const std::size_t first : firsts) {
      for (std::size_t k = first; k < first + order; ++k) knots_.push_back(k);
    }
    std::sort(knots_.begin(), knots_.end());
    knots_.erase(std::unique(knots_.begin(), knots_.end()), knots_.end());
    for (const std::size_t k : knots_) append(columns.layout.knot[k], 6);
    cameras_.resize(state.rig.cameras.size());
    std::vector<bool> known(cameras_.size());
    for (const Sighting& s : track.sightings) {
      if (known[s.camera]) continue;
      known[s.camera] = true;
      const CameraColumns& global = columns.parameters.cameras[s.camera];
      const auto lens = static_cast<int>(state.rig.cameras[s.camera].lens.params.size());
      cameras_[s.camera] = {append(global.translation, 3), append(global.rotation, 3), append(global.intrinsics, lens),
                            append(global.time_offset, 1), append(global.line_delay, 1)};
    }
  }

  const std::vector<int>& column() const { return column_; }
  int knot(std::size_t k) const {
    return 6 * static_cast<int>(std::lower_bound(knots_.begin(), knots_.end(), k) - knots_.begin());
  }
  const CameraColumns& camera(std::size_t c) const { return cameras_[c]; }

 private:
  int append(int first, int size) {
    if (first < 0) return -1;
    const int local = static_cast<int>(column_.size());
    for (int i = 0; i < size; ++i) column_.push_back(first + i);
    return local;
  }

  std::vector<std::size_t> knots_;
  std::vector<CameraColumns> cameras_;
  std::vector<int> column_;
};

/// Rows with the local columns they have.
template <class Matrix>
struct Sparse {
  std::vector<int> local{};
  Matrix J{};

  template <class Block>
  void append(int first, const Block& block) {
    if (first < 0) return;
    const Eigen::Index at = J.cols();
    J.conservativeResize(Eigen::NoChange, at + block.cols());
    J.rightCols(block.cols()) = block;
    for (Eigen::Index i = 0; i < block.cols(); ++i) local.push_back(first + static_cast<int>(i));
  }
};

struct Reference {
  const Camera* camera;
  const Sighting* sighting;
  PoseSample at;
  AnchoredPoint anchor;
};

Reference reference_of(const State& state, const Track& track, bool derivatives) {
  const Sighting& s = track.sightings.front();
  const Camera& camera = state.rig.cameras[s.camera];
  PoseSample at = state.curve->pose({s.stamp, camera.delay_s(s.px)}, derivatives);
  AnchoredPoint anchor = linearize_anchor(camera, at.T_w_b, state.landmarks[track.landmark]);
  return {&camera, &s, std::move(at), std::move(anchor)};
}

/// What one sighting contributes, whitened and weighted: rows of the pixel; empty if it is lost.
struct Seen {
  Eigen::Matrix2d scale;
  Vector2d r;       ///< in sigmas
  double root = 1;  ///< square root of the robust weight
  Vector2d ydot;
  Reprojection image;
};

std::optional<Seen> see(const State& state, const TrackModel& model, const Track& track, std::size_t sighting,
                        const PoseSample& at, const HomogeneousPoint& point) {
  const Sighting& s = track.sightings[sighting];
  if (!track.whitening.empty() && !track.whitening[sighting]) return std::nullopt;
  const auto image = linearize_reprojection(state.rig.cameras[s.camera], at.T_w_b, point);
  if (!image) return std::nullopt;
  Seen seen{{}, {}, 1.0, image->d_pose * at.twist_b, *image};
  seen.scale = Eigen::Matrix2d::Identity() / model.sigma_px[s.camera];
  if (!track.whitening.empty()) seen.scale = *track.whitening[sighting] / model.sigma_px[s.camera];
  seen.r = seen.scale * (image->px - s.px);
  seen.root = std::sqrt(model.loss.weight(seen.r.squaredNorm()));
  return seen;
}

double lost_cost(const TrackModel& model) { return 0.5 * model.loss.loss(kLostSigmas * kLostSigmas); }

/// Image of the point in the reference view itself; only the bearing and the lens move it.
struct ReferenceRows {
  Vector2d r = Vector2d::Zero();
  Eigen::Matrix2d scale = Eigen::Matrix2d::Zero();
  double root = 1.0;
  LensProjection image{};
};

std::optional<ReferenceRows> reference_rows(const State& state, const TrackModel& model, const Track& track,
                                            const Reference& reference) {
  const auto seen = see(state, model, track, 0, reference.at, reference.anchor.point);
  const auto image = reference.camera->lens.linearize(state.landmarks[track.landmark].bearing_c);
  if (!seen || !image) return std::nullopt;
  return ReferenceRows{seen->r, seen->scale, seen->root, *image};
}

Sparse<Matrix4X> reference_columns(const Reference& reference, const TrackModel& model, const TrackColumns& columns) {
  Sparse<Matrix4X> Q;
  const CameraColumns& camera = columns.camera(reference.sighting->camera);
  const AnchoredPoint& anchor = reference.anchor;
  const Eigen::Vector4d rate = anchor.d_pose * reference.at.twist_b;
  const double line = reference.camera->shutter.line(reference.sighting->px, reference.camera->resolution_px);
  Q.append(columns.knot(reference.at.d_knots.first), (anchor.d_pose * reference.at.d_knots.J).eval());
  Q.append(camera.translation, anchor.d_T_c_b.leftCols<3>());
  Q.append(camera.rotation, anchor.d_T_c_b.rightCols<3>());
  Q.append(camera.time_offset, rate);
  Q.append(camera.line_delay, (line * rate).eval());
  if (model.unknowns == LandmarkUnknowns::kInverseDepth && camera.intrinsics >= 0) {
    const auto ray = reference.camera->lens.linearize_ray(reference.sighting->px);
    if (ray) Q.append(camera.intrinsics, (anchor.d_bearing * ray->d_params).eval());
  }
  return Q;
}

Sparse<Matrix2X> sighting_columns(const Camera& camera, const Sighting& s, const PoseSample& at, const Seen& seen,
                                  const TrackColumns& columns) {
  Sparse<Matrix2X> A;
  const CameraColumns& local = columns.camera(s.camera);
  A.append(columns.knot(at.d_knots.first), (seen.image.d_pose * at.d_knots.J).eval());
  A.append(local.translation, seen.image.d_T_c_b.leftCols<3>());
  A.append(local.rotation, seen.image.d_T_c_b.rightCols<3>());
  A.append(local.intrinsics, seen.image.d_lens);
  A.append(local.time_offset, seen.ydot);
  A.append(local.line_delay, (camera.shutter.line(s.px, camera.resolution_px) * seen.ydot).eval());
  A.J = (seen.root * seen.scale * A.J).eval();
  return A;
}

std::vector<int> global_columns(const std::vector<int>& local, const std::vector<int>& column) {
  std::vector<int> global(local.size());
  std::transform(local.begin(), local.end(), global.begin(),
                 [&](int i) { return column[static_cast<std::size_t>(i)]; });
  return global;
}

template <class Matrix>
void add_to(const std::vector<int>& index, const Matrix& values, Eigen::Ref<Eigen::VectorXd> sum) {
  for (std::size_t i = 0; i < index.size(); ++i) sum(index[i]) += values(static_cast<Eigen::Index>(i));
}

using LandmarkRows = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, 3>;

/// d point / d landmark: four rows.
LandmarkRows landmark_columns(const AnchoredPoint& anchor, const TrackModel& model, const Vector3d& bearing_c) {
  LandmarkRows Q(4, model.size());
  if (model.unknowns == LandmarkUnknowns::kPoint) Q.leftCols<2>() = anchor.d_bearing * plane_across(bearing_c);
  Q.rightCols<1>() = anchor.d_inverse_distance;
  return Q;
}

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
    const auto Q_l = landmark_columns(reference_.anchor, model_, landmark().bearing_c);
    block_.W = Q_l.transpose().lazyProduct(C_);
    block_.H.topLeftCorner(n_, n_) = Q_l.transpose() * S_ * Q_l;
    block_.g.head(n_) = Q_l.transpose() * s_;
    model_.unknowns == LandmarkUnknowns::kPoint ? carried_by_reference(Q, Q_l) : along_reference_ray(Q, Q_l);
    hold_at_infinity();
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
    H_.setZero(A_t_.rows(), A_t_.rows());
    tiles::add_gram(A_t_.data(), static_cast<int>(A_t_.rows()), 2, H_.data());
    system_.add(global_, H_);
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

  /// A landmark on an exact ray: the point depends on the reference view and on the landmark.
  void along_reference_ray(const Sparse<Matrix4X>& Q, const LandmarkRows& Q_l) {
    const std::vector<int> global = global_columns(Q.local, block_.column);
    system_.add(global, Q.J.transpose() * S_ * Q.J);
    add_to(global, Q.J.transpose() * s_, gradient_);
    const Eigen::MatrixXd C_t = C_.transpose();
    system_.add_symmetric(block_.column, global, C_t.lazyProduct(Q.J));
    const Eigen::MatrixXd W = Q_l.transpose() * S_ * Q.J;
    for (std::size_t i = 0; i < Q.local.size(); ++i) {
      block_.W.col(Q.local[i]) += W.col(static_cast<Eigen::Index>(i));
    }
  }

  /// A point that has its own three unknowns. The reference view moves it as the landmark could: Q = Q_l carry, up to a
  /// multiple of the homogeneous point, which no image sees. What is left of that view is the residual of its pixel.
  void carried_by_reference(const Sparse<Matrix4X>& Q, const LandmarkRows& Q_l) {
    const HomogeneousPoint& point = reference_.anchor.point;
    Eigen::Matrix4d basis;
    basis << Q_l, (Eigen::Vector4d() << point.direction_w, point.inverse_distance).finished();
    block_.carry = (basis.inverse() * Q.J).topRows<3>();
    block_.carried = global_columns(Q.local, block_.column);
    const auto rows = reference_rows(state_, model_, track_, reference_);
    if (!rows) return lose();
    block_.cost += 0.5 * model_.loss.loss(rows->r.squaredNorm());
    const Eigen::Matrix2d scale = rows->root * rows->scale;
    const Vector2d r = rows->root * rows->r;
    const Eigen::Matrix2d J_l = scale * rows->image.d_point * plane_across(landmark().bearing_c);
    Sparse<Matrix2X> A{Q.local, -J_l * block_.carry.topRows<2>()};
    A.append(columns_.camera(reference_.sighting->camera).intrinsics, (scale * rows->image.d_params).eval());
    add(A, r);
    for (std::size_t i = 0; i < A.local.size(); ++i) {
      block_.W.col(A.local[i]).head<2>() += J_l.transpose() * A.J.col(static_cast<Eigen::Index>(i));
    }
    block_.H.topLeftCorner<2, 2>() += J_l.transpose() * J_l;
    block_.g.head<2>() += J_l.transpose() * r;
  }

  /// A point at infinity that wants to go beyond stays there: its inverse distance is no unknown of this step.
  void hold_at_infinity() {
    const Eigen::Index rho = n_ - 1;
    if (landmark().inverse_distance > 0.0 || block_.g(rho) <= 0.0) return;
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
  std::vector<int> global_;  ///< with A_t_ and H_, room for the products of rows
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, kMostColumns, 2> A_t_;
  Eigen::MatrixXd H_;
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
