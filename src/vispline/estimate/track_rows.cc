#include "vispline/estimate/track_rows.h"

#include "vispline/estimate/track_kernel.h"

namespace vispline {
namespace {

using namespace track_kernel;

/// Adds B to the columns of `rows` that are called by B's local ones, appending those that are new.
template <class Block>
void add_columns(const std::vector<int>& global, const Block& B, SightingRows& rows) {
  for (std::size_t i = 0; i < global.size(); ++i) {
    const auto found = std::find(rows.column.begin(), rows.column.end(), global[i]);
    const auto at = static_cast<Eigen::Index>(found - rows.column.begin());
    if (found == rows.column.end()) {
      rows.column.push_back(global[i]);
      rows.J.conservativeResize(Eigen::NoChange, at + 1);
      rows.J.col(at).setZero();
    }
    rows.J.col(at) += B.col(static_cast<Eigen::Index>(i));
  }
}

}  // namespace

std::vector<SightingRows> linearize_sightings(const State& state, const Columns& columns, const TrackModel& model,
                                              const Track& track) {
  const TrackColumns local(state, columns, track);
  const Reference reference = reference_of(state, track, true);
  const InverseDepthLandmark& landmark = state.landmarks[track.landmark];
  const Sparse<Matrix4X> Q = reference_columns(reference, model, local);
  const LandmarkRows Q_l = landmark_columns(reference.anchor, model, landmark.bearing_c);
  std::vector<SightingRows> all(track.sightings.size());
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Sighting& s = track.sightings[i];
    const Camera& camera = state.rig.cameras[s.camera];
    const PoseSample at = state.curve->pose({s.stamp, camera.delay_s(s.px)}, true);
    auto seen = see(state, model, track, i, at, reference.anchor.point);
    all[i].lost = !seen;
    if (!seen) continue;
    all[i].r = seen->r;
    all[i].weight = seen->root * seen->root;
    seen->root = 1.0;
    const Sparse<Matrix2X> A = sighting_columns(camera, s, at, *seen, local);
    const Eigen::Matrix<double, 2, 4> q = seen->scale * seen->image.d_point;
    add_columns(global_columns(A.local, local.column()), A.J, all[i]);
    add_columns(global_columns(Q.local, local.column()), q * Q.J, all[i]);
    all[i].J_landmark.leftCols(model.size()) = q * Q_l;
  }
  if (model.unknowns == LandmarkUnknowns::kInverseDepth) return all;
  const auto rows = reference_rows(state, model, track, reference);
  all[0].lost = !rows;
  if (!rows) return all;
  all[0].r = rows->r;
  all[0].weight = rows->root * rows->root;
  all[0].J_landmark.leftCols<2>() = rows->scale * rows->image.d_point * plane_across(landmark.bearing_c);
  Sparse<Matrix2X> A;
  A.append(local.camera(track.sightings[0].camera).intrinsics, (rows->scale * rows->image.d_params).eval());
  add_columns(global_columns(A.local, local.column()), A.J, all[0]);
  return all;
}

}  // namespace vispline
