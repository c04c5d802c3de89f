/// What every view of a track contributes, shared by those who build normal equations and rows from it.
/// docs/math/estimate.md, Tracks.
#pragma once

#include <cmath>
#include <optional>

#include "vispline/estimate/plane_across.h"
#include "vispline/estimate/track.h"
#include "vispline/estimate/view_rows.h"
#include "vispline/sensors/rolling_shutter.h"

namespace vispline::track_kernel {

inline Instant instant_of(const State& state, const Sighting& s) {
  return {s.stamp, state.rig.cameras[s.camera].delay_s(s.px)};
}

struct Reference {
  const Camera* camera;
  const Sighting* sighting;
  PoseSample at;
  AnchoredPoint anchor;
};

inline Reference reference_of(const State& state, const Track& track, bool derivatives) {
  const Sighting& s = track.sightings.front();
  const Camera& camera = state.rig.cameras[s.camera];
  PoseSample at = state.curve->sample(instant_of(state, s), derivatives);
  AnchoredPoint anchor = linearize_anchor(camera, at.T_w_b, state.landmarks[track.landmark]);
  return {&camera, &s, std::move(at), std::move(anchor)};
}

inline double lost_cost(const TrackModel& model) { return 0.5 * model.loss.loss(kLostSigmas * kLostSigmas); }

inline std::optional<Eigen::Matrix2d> whitening_of(const Track& track, std::size_t sighting) {
  return track.whitening.empty() ? Eigen::Matrix2d(Eigen::Matrix2d::Identity()) : track.whitening[sighting];
}

/// One sighting with its derivatives.
struct Seen {
  Reprojection image;
  Vector2d ydot;  ///< px/s, of the image as the body moves
  Eigen::Matrix2d whitening;
  Eigen::Matrix2d scale;  ///< from px to sigmas
  Vector2d r;             ///< in sigmas
  double root;            ///< square root of the robust weight
};

/// Empty if it is lost. `kept`: the whitening; none: that of the state itself.
inline std::optional<Seen> see(const State& state, const TrackModel& model, const Sighting& s, const Pose& T_w_b,
                               const Vector6d& twist_b, const HomogeneousPoint& point,
                               const std::optional<Eigen::Matrix2d>* kept) {
  const Camera& camera = state.rig.cameras[s.camera];
  const auto image = linearize_reprojection(camera, T_w_b, point);
  if (!image) return std::nullopt;
  const Vector2d ydot = image->d_pose * twist_b;
  const auto whitening = kept != nullptr ? *kept : newton_whitening(camera.shutter, ydot);
  if (!whitening) return std::nullopt;
  const Eigen::Matrix2d scale = *whitening / model.sigma_px[s.camera];
  const Vector2d r = scale * (image->px - s.px);
  return Seen{*image, ydot, *whitening, scale, r, std::sqrt(model.loss.weight(r.squaredNorm()))};
}

/// see() from where the curve is, with the derivatives by the knots, weighted.
struct SeenByKnots {
  std::optional<Seen> seen{};
  KnotRows<2> d_knots{};
};
inline SeenByKnots see(const State& state, const TrackModel& model, const Sighting& s, const HomogeneousPoint& point,
                       const std::optional<Eigen::Matrix2d>* kept) {
  SeenByKnots out;
  out.d_knots = state.curve->pull_back_pixel(instant_of(state, s), [&](const Pose& T_w_b, const Vector6d& twist_b) {
    out.seen = see(state, model, s, T_w_b, twist_b, point, kept);
    return out.seen ? Matrix2x6(out.seen->root * out.seen->scale * out.seen->image.d_pose) : Matrix2x6::Zero();
  });
  return out;
}

/// By the knots and the camera of the sighting, in sigmas and weighted.
inline ViewRows<2> rows_of(const State& state, const CameraColumns& columns, const Sighting& s, const Seen& seen,
                           const KnotRows<2>& d_knots) {
  const Camera& camera = state.rig.cameras[s.camera];
  const Eigen::Matrix2d scale = seen.root * seen.scale;
  ViewRows<2> rows;
  rows.set_knots(d_knots);
  rows.append(columns.translation, (scale * seen.image.d_T_c_b.leftCols<3>()).eval());
  rows.append(columns.rotation, (scale * seen.image.d_T_c_b.rightCols<3>()).eval());
  if (columns.intrinsics >= 0) rows.append(columns.intrinsics, scale.lazyProduct(seen.image.d_lens).eval());
  rows.append(columns.time_offset, (scale * seen.ydot).eval());
  rows.append(columns.line_delay, (camera.shutter.line(s.px, camera.resolution_px) * scale * seen.ydot).eval());
  return rows;
}

/// A lens turns the ray of an exact reference pixel; a point has a bearing of its own.
inline Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, kMaxLensParams> by_lens(const Reference& reference,
                                                                                            const TrackModel& model) {
  const Lens& lens = reference.camera->lens;
  const auto ray =
      model.unknowns == LandmarkUnknowns::kInverseDepth ? lens.linearize_ray(reference.sighting->px) : std::nullopt;
  if (!ray) return Eigen::MatrixXd::Zero(4, lens.params.size());
  return reference.anchor.d_bearing * ray->d_params;
}

/// The point in the world by the knots and the camera of the reference view.
inline ViewRows<4> rows_of(const Reference& reference, const TrackModel& model, const CameraColumns& columns) {
  const AnchoredPoint& anchor = reference.anchor;
  const Eigen::Vector4d rate = anchor.d_pose * reference.at.twist_b;
  const double line = reference.camera->shutter.line(reference.sighting->px, reference.camera->resolution_px);
  ViewRows<4> rows;
  rows.set_knots(anchor.d_pose * reference.at.d_knots);
  rows.append(columns.translation, anchor.d_T_c_b.leftCols<3>());
  rows.append(columns.rotation, anchor.d_T_c_b.rightCols<3>());
  if (columns.intrinsics >= 0) rows.append(columns.intrinsics, by_lens(reference, model));
  rows.append(columns.time_offset, rate);
  rows.append(columns.line_delay, (line * rate).eval());
  return rows;
}

/// Image of the point in the reference view itself; only the bearing and the lens move it.
struct ReferencePixel {
  Seen seen;
  Eigen::Matrix<double, 2, 3> d_bearing;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMaxLensParams> d_lens;
};

inline std::optional<ReferencePixel> reference_pixel(const State& state, const TrackModel& model, const Track& track,
                                                     const Reference& reference,
                                                     const std::optional<Eigen::Matrix2d>* kept) {
  const auto seen =
      see(state, model, *reference.sighting, reference.at.T_w_b, reference.at.twist_b, reference.anchor.point, kept);
  const auto image = reference.camera->lens.linearize(state.landmarks[track.landmark].bearing_c);
  if (!seen || !image) return std::nullopt;
  return ReferencePixel{*seen, image->d_point, image->d_params};
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
