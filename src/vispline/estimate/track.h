/// A landmark and all its images. The landmark is eliminated before the rest is solved for. docs/math/estimate.md,
/// Tracks.
#pragma once

#include <optional>
#include <vector>

#include "vispline/estimate/measurement.h"

namespace vispline {

class TrackColumns;
class ViewSums;

struct Sighting {
  std::size_t camera = 0;  ///< of the rig
  Time stamp{};            ///< of the frame, on the camera's clock
  Vector2d px = Vector2d::Zero();
};

/// Of each sighting, newton_whitening(); empty: not to be predicted.
using Whitening = std::vector<std::optional<Eigen::Matrix2d>>;

/// The first sighting is the reference view, whose camera the landmark is anchored in.
struct Track {
  std::size_t landmark = 0;  ///< of the state
  std::vector<Sighting> sightings{};
  Whitening whitening{};  ///< none at all: identity
};

/// Fixes the whitening of every sighting by the state, until the next call.
void whiten(const State& state, Track& track);

enum class LandmarkUnknowns {
  kInverseDepth,  ///< the paper's: one, along the ray of the reference pixel, which counts as exact
  kPoint,         ///< three: the reference pixel has noise and a residual as any other
};

struct TrackModel {
  LandmarkUnknowns unknowns = LandmarkUnknowns::kPoint;
  std::vector<double> sigma_px{};  ///< by camera of the rig
  Huber loss{};

  int size() const { return unknowns == LandmarkUnknowns::kPoint ? 3 : 1; }
};

/// Squared residuals of a track, for cost and statistics.
struct TrackResiduals {
  std::vector<Vector2d> r{};  ///< one for each sighting, in sigmas; zero where lost, and of an exact reference pixel
  double cost = 0.0;
  std::size_t lost = 0;
};
TrackResiduals evaluate_track(const State& state, const TrackModel& model, const Track& track);

/// Normal equations of one track, [H W^T; W H_l] [delta; delta_l] = -[g; g_l]. A point (kPoint) is moved in the world
/// here, as if its reference view stood still: only then do the images not depend on that view. The landmark itself
/// moves by delta_l - carry * delta(reference)                                          docs/math/estimate.md, Tracks
struct TrackBlock {
  std::vector<int> column{};     ///< of W and g
  std::vector<int> reference{};  ///< columns of the reference view
  Eigen::VectorXd g{};
  Eigen::MatrixXd W_t{};      ///< column x size()
  Eigen::MatrixXd carry_t{};  ///< reference x size(); empty if the landmark does not move with its view
  /// H has C Q^T at (column, reference) and its transpose besides what is in the sums of the views; both may be empty.
  Eigen::Matrix<double, Eigen::Dynamic, 4> C{}, Q{};
  Eigen::Matrix3d H_l = Eigen::Matrix3d::Zero();
  Vector3d g_l = Vector3d::Zero();
  Whitening whitening{};  ///< by the state
  double cost = 0.0;
  std::size_t lost = 0;
};

enum class Weights {
  kKept,     ///< the whitening that the tracks have
  kRenewed,  ///< that of the state
};

/// What of H is in its columns alone goes to `views`.
TrackBlock linearize_track(const State& state, const Columns& columns, const TrackColumns& local,
                           const TrackModel& model, const Track& track, Weights weights, ViewSums& views);

/// The landmark moved by delta (three numbers: across the bearing, then the inverse distance; or the last one only). It
/// stays in front: an inverse distance below 0 becomes 0.
InverseDepthLandmark moved(const InverseDepthLandmark& landmark, const TrackModel& model, const Vector3d& delta);

}  // namespace vispline
