/// A landmark and all its images. The landmark is eliminated before the rest is solved for. docs/math/estimate.md,
/// Tracks.
#pragma once

#include <optional>
#include <vector>

#include "vispline/estimate/measurement.h"
#include "vispline/estimate/skyline.h"

namespace vispline {

struct Sighting {
  std::size_t camera = 0;  ///< of the rig
  Time stamp{};            ///< of the frame, on the camera's clock
  Vector2d px = Vector2d::Zero();
};

/// The first sighting is the reference view, whose camera the landmark is anchored in.
struct Track {
  std::size_t landmark = 0;  ///< of the state
  std::vector<Sighting> sightings{};
  std::vector<std::optional<Eigen::Matrix2d>> whitening{};  ///< of each; none at all: identity; see whiten()
};

/// Fixes line_whitening() of every sighting by the state, until the next call.
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

/// Columns that a track touches; for Skyline::couple().
std::vector<int> columns_of(const State& state, const Columns& columns, const Track& track);

/// Normal equations of one track, [H W^T; W H_l] [delta; delta_l] = -[g; g_l]: its part of H and g is added to the
/// system at once, the rest waits for the damping. A point (kPoint) is moved in the world here, as if its reference
/// view stood still: only then do the images not depend on that view. The landmark itself moves by
///   delta_l - carry * delta(carried)                                                   docs/math/estimate.md, Tracks
struct TrackBlock {
  std::vector<int> column{};   ///< of W
  Eigen::MatrixXd W{};         ///< size() x columns
  std::vector<int> carried{};  ///< columns that carry the landmark with them; none for kInverseDepth
  Eigen::MatrixXd carry{};     ///< size() x carried
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Vector3d g = Vector3d::Zero();
  double cost = 0.0;
  std::size_t lost = 0;
};
TrackBlock linearize_track(const State& state, const Columns& columns, const TrackModel& model, const Track& track,
                           Skyline& system, Eigen::VectorXd& gradient);

/// The landmark moved by delta (three numbers: across the bearing, then the inverse distance; or the last one only). It
/// stays in front: an inverse distance below 0 becomes 0.
InverseDepthLandmark moved(const InverseDepthLandmark& landmark, const TrackModel& model, const Vector3d& delta);

}  // namespace vispline
