/// What every view of a track contributes, shared by those who build normal equations and rows from it.
/// docs/math/estimate.md, Tracks.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "vispline/estimate/plane_across.h"
#include "vispline/estimate/reprojection.h"
#include "vispline/estimate/track.h"

namespace vispline::track_kernel {

inline constexpr int kMostColumns = 6 * kMaxOrder + 8 + kMaxLensParams;
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

inline Reference reference_of(const State& state, const Track& track, bool derivatives) {
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

inline std::optional<Seen> see(const State& state, const TrackModel& model, const Track& track, std::size_t sighting,
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

inline double lost_cost(const TrackModel& model) { return 0.5 * model.loss.loss(kLostSigmas * kLostSigmas); }

/// Image of the point in the reference view itself; only the bearing and the lens move it.
struct ReferenceRows {
  Vector2d r = Vector2d::Zero();
  Eigen::Matrix2d scale = Eigen::Matrix2d::Zero();
  double root = 1.0;
  LensProjection image{};
};

inline std::optional<ReferenceRows> reference_rows(const State& state, const TrackModel& model, const Track& track,
                                                   const Reference& reference) {
  const auto seen = see(state, model, track, 0, reference.at, reference.anchor.point);
  const auto image = reference.camera->lens.linearize(state.landmarks[track.landmark].bearing_c);
  if (!seen || !image) return std::nullopt;
  return ReferenceRows{seen->r, seen->scale, seen->root, *image};
}

inline Sparse<Matrix4X> reference_columns(const Reference& reference, const TrackModel& model,
                                          const TrackColumns& columns) {
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

inline Sparse<Matrix2X> sighting_columns(const Camera& camera, const Sighting& s, const PoseSample& at,
                                         const Seen& seen, const TrackColumns& columns) {
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

inline std::vector<int> global_columns(const std::vector<int>& local, const std::vector<int>& column) {
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
inline LandmarkRows landmark_columns(const AnchoredPoint& anchor, const TrackModel& model, const Vector3d& bearing_c) {
  LandmarkRows Q(4, model.size());
  if (model.unknowns == LandmarkUnknowns::kPoint) Q.leftCols<2>() = anchor.d_bearing * plane_across(bearing_c);
  Q.rightCols<1>() = anchor.d_inverse_distance;
  return Q;
}

}  // namespace vispline::track_kernel
