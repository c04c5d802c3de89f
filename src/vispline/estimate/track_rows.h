/// A track as rows with derivatives, for engines that do their own elimination. docs/math/estimate.md, Tracks.
#pragma once

#include "vispline/estimate/track.h"

namespace vispline {

/// One sighting: residual in sigmas and its derivatives, both times the root of the robust weight rho'. A lost one is
/// zero and has the squares of a lost reading.
struct SightingRows {
  Vector2d r = Vector2d::Zero();
  double squares = 0.0;       ///< of the residual, before it was weighted
  std::vector<int> column{};  ///< of the view, then of the reference view: what stands twice adds up
  Eigen::Matrix<double, 2, Eigen::Dynamic> J{};
  Eigen::Matrix<double, 2, 3> J_landmark = Eigen::Matrix<double, 2, 3>::Zero();  ///< the first size() columns count
  bool lost = false;
};

/// Sets one for each sighting, whitened by the state itself; that of an exact reference pixel has no columns. Without
/// `derivatives` all J are those of before.
void evaluate_sightings(const State& state, const Columns& columns, const TrackModel& model, const Track& track,
                        bool derivatives, std::vector<SightingRows>& all);

}  // namespace vispline
