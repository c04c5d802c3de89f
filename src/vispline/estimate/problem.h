/// One joint least-squares problem: unknowns, what is to be done with them, and everything that was measured.
/// Lovegrove et al. 2013, equation (10). docs/math/estimate.md.
#pragma once

#include <memory>
#include <vector>

#include "vispline/estimate/measurement.h"
#include "vispline/estimate/track.h"

namespace vispline {

/// `measurements` may look at samples that the caller keeps alive.
struct Problem {
  State start{};
  std::vector<Parameter> parameters{};
  std::vector<std::unique_ptr<Measurement>> measurements{};
  std::vector<Track> tracks{};
  TrackModel track_model{};
};

/// Fixes the weights of all rows by the state; the same for any number of threads.
void whiten_measurements(Problem& problem, const State& state, std::size_t threads);
void whiten(Problem& problem, const State& state, std::size_t threads);

/// Gives every free unknown its columns: knots and bias nodes in the order of time, then parameters.
Columns assign_columns(const State& state, std::vector<Parameter>& parameters);

/// The state moved by one step of the solver. `delta_landmark` has three numbers for every track, see moved().
State moved(const State& state, const Columns& columns, const std::vector<Parameter>& parameters,
            const Eigen::VectorXd& delta, const Problem& problem, const std::vector<Vector3d>& delta_landmark);

}  // namespace vispline
