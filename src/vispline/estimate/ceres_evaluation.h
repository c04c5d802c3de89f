/// What Ceres sees of a problem: unknowns as plain numbers, and the rows of everything measured, made once for each
/// point by the kernels of our own solver. docs/math/estimate.md, The solver.
#pragma once

#include <ceres/evaluation_callback.h>

#include "vispline/estimate/problem.h"
#include "vispline/estimate/track_rows.h"

namespace vispline::through_ceres {

/// Unknowns that Ceres moves together: some knots in a row, the node of a bias, a parameter.
struct Block {
  double* x = nullptr;
  int size = 0;
};

/// Where a column stands.
struct Place {
  std::size_t block = 0;
  int offset = 0;
};

/// All in one piece of memory: Ceres takes blocks in the order of their addresses.
class Unknowns {
 public:
  Unknowns(const Columns& columns, const std::vector<Parameter>& parameters, std::size_t tracks);
  Unknowns(const Unknowns&) = delete;
  Unknowns& operator=(const Unknowns&) = delete;

  const std::vector<Block>& blocks() const { return blocks_; }
  const Place& place(int column) const { return place_[static_cast<std::size_t>(column)]; }
  double* landmark(std::size_t track) { return landmarks_[track].data(); }
  const std::vector<Vector3d>& landmarks() const { return landmarks_; }
  Eigen::VectorXd by_column() const;

 private:
  void add(const std::vector<int>& columns);

  std::vector<double> x_;
  std::vector<int> column_;  ///< of each x
  std::vector<Block> blocks_;
  std::vector<Place> place_;
  std::vector<Vector3d> landmarks_;
};

/// Numbers mean the way from the state that was linearised last, where they are perturbations: Ceres only ever adds
/// steps to the point that it has derivatives of, so it needs no manifold. Weights that depend on the state are those
/// of each point itself, without derivatives: what is zero at the end is J^T r, as with our own solver.
class Evaluation final : public ceres::EvaluationCallback {
 public:
  Evaluation(Problem& problem, const State& start, const Columns& columns, const std::vector<Parameter>& parameters,
             std::size_t threads);

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  Unknowns& unknowns() { return unknowns_; }
  /// The state that the numbers mean.
  State state() const;

  /// By measurement, then by sighting of each track.
  const std::vector<Rows>& measured() const { return measured_; }
  const std::vector<std::vector<SightingRows>>& seen() const { return seen_; }

 private:
  void evaluate(bool derivatives);

  Problem& problem_;
  const Columns& columns_;
  const std::vector<Parameter>& parameters_;
  std::size_t threads_;
  Unknowns unknowns_;
  State linearized_;
  Eigen::VectorXd x_linearized_;
  std::vector<Vector3d> landmarks_linearized_;
  std::vector<Rows> measured_;
  std::vector<std::vector<SightingRows>> seen_;
  bool untouched_ = true;  ///< what is there is of the start, with derivatives
};

}  // namespace vispline::through_ceres
