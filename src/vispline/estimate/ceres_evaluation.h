/// What Ceres sees of a problem: unknowns as coordinates around a base state, and the rows of everything measured, made
/// once for each point by the kernels of our own solver. docs/math/estimate.md, The solver.
#pragma once

#include <ceres/evaluation_callback.h>

#include "vispline/estimate/problem.h"
#include "vispline/estimate/track_rows.h"

namespace vispline::through_ceres {

/// Rows of one residual block. With w the robust weight rho', a row r counts as sqrt(w) r, and so do its derivatives:
/// the gradient is exact, the curvature that of our own solver. What is left of the cost, sum(rho - w r^2) >= 0 and
/// readings that cannot be predicted, is the last row, which has no derivatives.
struct Residuals {
  Eigen::VectorXd r{};
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J{};
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J_landmark{};
  std::vector<int> column{};
};

class Evaluation final : public ceres::EvaluationCallback {
 public:
  Evaluation(const Problem& problem, const State& base, const Columns& columns,
             const std::vector<Parameter>& parameters, std::size_t threads);

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  /// Where Ceres keeps its numbers: zero at the base state.
  double* unknowns(int column) { return x_.data() + column; }
  double* landmark(std::size_t track) { return x_landmark_[track].data(); }
  const State& base() const { return base_; }
  /// The state that the numbers mean.
  State state() const;

  /// By measurement, then by sighting of each track.
  std::vector<Residuals>& measured() { return measured_; }
  std::vector<std::vector<Residuals>>& seen() { return seen_; }

 private:
  void evaluate(bool derivatives);

  const Problem& problem_;
  const State base_;
  const Columns& columns_;
  const std::vector<Parameter>& parameters_;
  std::size_t threads_;
  Eigen::VectorXd x_;
  std::vector<Vector3d> x_landmark_;
  std::vector<Residuals> measured_;
  std::vector<std::vector<Residuals>> seen_;
};

}  // namespace vispline::through_ceres
