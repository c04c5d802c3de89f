/// Levenberg-Marquardt on the structure of the problem: landmarks eliminated, time in a band, parameters in an arrow.
/// docs/math/estimate.md, The solver.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "vispline/estimate/problem.h"

namespace vispline {

struct IterationRow {
  int iteration = 0;
  double cost = 0.0;       ///< after it
  double decrease = 0.0;   ///< of the cost; what the quadratic model promised is `predicted`
  double predicted = 0.0;  ///< half the squared length of the step, in sigmas
  double lambda = 0.0;
  bool accepted = false;
};

enum class Engine {
  kOwn,    ///< ours: exploits the structure
  kCeres,  ///< the same rows through Ceres, the independent check
};

struct SolveOptions {
  Engine engine = Engine::kOwn;
  int max_iterations = 50;
  double least_decrease = 1e-5;  ///< converged when a step promises less: 1e-5 is a step of 0.0045 sigma in all
  double relative_decrease = 1e-9;
  double first_lambda = 1e-6;
  std::size_t threads = 1;                              ///< does not change a byte of the result
  std::function<bool(const IterationRow&)> progress{};  ///< false: stop and keep the best state so far
  bool covariance = true;  ///< with it the equations at the solution, which assess() and jackknife() ask for
};

class NormalEquations;

enum class SolveStatus { kConverged, kIterationLimit, kStopped, kFailed };

struct Solution {
  State state{};
  std::vector<Parameter> parameters{};  ///< with the columns they had
  Columns columns{};
  SolveStatus status = SolveStatus::kFailed;
  double first_cost = 0.0, cost = 0.0;
  std::size_t lost = 0;  ///< readings that cannot be predicted at the solution
  std::vector<IterationRow> iterations{};
  std::shared_ptr<const NormalEquations> equations{};  ///< at `state`
  bool full_rank = false;                              ///< the information matrix could be factored without damping
  Eigen::MatrixXd covariance{};  ///< of the parameters that are not fixed, in their order; empty without full rank
};

/// The weights that depend on the state are fixed anew before every linearisation: what is solved is the estimating
/// equation, not the minimum over a moving metric. The problem keeps the weights of the solution.
Solution solve(Problem& problem, const SolveOptions& options);

}  // namespace vispline
