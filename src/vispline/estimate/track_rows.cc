#include "vispline/estimate/track_rows.h"

#include "vispline/estimate/track_kernel.h"

namespace vispline {
namespace {

using namespace track_kernel;

/// The columns of A, then those of Q that A does not have; where both have one, the sum.
void set_columns(const std::vector<int>& global_A, const Eigen::Ref<const Eigen::MatrixXd>& A,
                 const std::vector<int>& global_Q, const Eigen::Ref<const Eigen::MatrixXd>& Q, SightingRows& rows) {
  rows.column = global_A;
  rows.J.setZero(2, A.cols() + Q.cols());
  rows.J.leftCols(A.cols()) = A;
  for (std::size_t i = 0; i < global_Q.size(); ++i) {
    const auto found = std::find(rows.column.begin(), rows.column.end(), global_Q[i]);
    const auto at = static_cast<Eigen::Index>(found - rows.column.begin());
    if (found == rows.column.end()) rows.column.push_back(global_Q[i]);
    rows.J.col(at) += Q.col(static_cast<Eigen::Index>(i));
  }
  rows.J.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(rows.column.size()));
}

}  // namespace

std::vector<SightingRows> linearize_sightings(const State& state, const Columns& columns, const TrackModel& model,
                                              const Track& track) {
  const TrackColumns local(state, columns, track);
  const Reference reference = reference_of(state, track, true);
  const InverseDepthLandmark& landmark = state.landmarks[track.landmark];
  const Sparse<Matrix4X> Q = reference_columns(reference, model, local);
  const LandmarkRows Q_l = landmark_columns(reference.anchor, model, landmark.bearing_c);
  const std::vector<int> global_Q = global_columns(Q.local, local.column());
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
    set_columns(global_columns(A.local, local.column()), A.J, global_Q, q * Q.J, all[i]);
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
  all[0].column = global_columns(A.local, local.column());
  all[0].J = A.J;
  return all;
}

}  // namespace vispline
