#include "vispline/estimate/solve.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "vispline/estimate/ceres_engine.h"
#include "vispline/estimate/normal_equations.h"

namespace vispline {
namespace {

constexpr double kLeastLambda = 1e-12, kMostLambda = 1e8;

/// Nielsen's rule: damping falls smoothly with the quality of a step, and rises ever faster while steps fail.
class Damping {
 public:
  explicit Damping(double lambda) : lambda_(lambda) {}
  double lambda() const { return lambda_; }
  bool exhausted() const { return lambda_ > kMostLambda; }
  void accept(double quality) {
    const double x = 2.0 * quality - 1.0;
    lambda_ = std::max(kLeastLambda, lambda_ * std::max(0.1, 1.0 - x * x * x));
    growth_ = 4.0;
  }
  void refuse() {
    lambda_ *= growth_;
    growth_ *= 2.0;
  }

 private:
  double lambda_;
  double growth_ = 4.0;
};

void finish(Problem& problem, const SolveOptions& options, Solution& solution) {
  if (!options.covariance || !std::isfinite(solution.cost)) return;
  solution.equations = std::make_shared<const NormalEquations>(
      NormalEquations::renewed(problem, solution.state, solution.columns, options.threads));
  const auto covariance = solution.equations->covariance(solution.columns.layout.parameters());
  solution.full_rank = covariance.has_value();
  if (covariance && solution.status != SolveStatus::kFailed) solution.covariance = *covariance;
}

void minimize(Problem& problem, const SolveOptions& options, Solution& solution) {
  Damping damping(options.first_lambda);
  CostAt at;
  bool done = false;
  int iteration = 0;
  while (!done && iteration < options.max_iterations) {
    const auto equations = NormalEquations::renewed(problem, solution.state, solution.columns, options.threads);
    at = {equations.cost(), equations.lost()};
    if (iteration == 0) solution.first_cost = at.cost;
    if (!std::isfinite(at.cost)) {
      solution.status = SolveStatus::kFailed;
      break;
    }
    for (bool accepted = false; !accepted && !done && iteration < options.max_iterations;) {
      IterationRow row{++iteration, at.cost, 0.0, 0.0, damping.lambda(), false};
      const auto step = equations.step(damping.lambda());
      if (step) {
        State next =
            moved(solution.state, solution.columns, solution.parameters, step->delta, problem, step->delta_landmark);
        const CostAt there = cost_at(problem, next, solution.columns, options.threads);
        row.predicted = step->predicted;
        row.decrease = at.cost - there.cost;
        const bool small = row.predicted < std::max(options.least_decrease, options.relative_decrease * at.cost);
        accepted = std::isfinite(there.cost) && row.decrease > 0.0;
        if (accepted) {
          solution.state = std::move(next);
          at = there;
          damping.accept(row.decrease / row.predicted);
        }
        if (small) {
          solution.status = SolveStatus::kConverged;
          done = true;
        }
      }
      if (!accepted) damping.refuse();
      row.cost = at.cost;
      row.accepted = accepted;
      solution.iterations.push_back(row);
      if (!done && damping.exhausted()) {
        solution.status = SolveStatus::kFailed;
        done = true;
      }
      if (options.progress && !options.progress(row) && !done) {
        solution.status = SolveStatus::kStopped;
        done = true;
      }
    }
  }
  solution.cost = at.cost;
  solution.lost = at.lost;
}

}  // namespace

Solution solve(Problem& problem, const SolveOptions& options) {
  Solution solution;
  solution.state = problem.start;
  solution.parameters = problem.parameters;
  solution.columns = assign_columns(solution.state, solution.parameters);
  solution.status = SolveStatus::kIterationLimit;
  (options.engine == Engine::kOwn ? minimize : minimize_with_ceres)(problem, options, solution);
  finish(problem, options, solution);
  return solution;
}

}  // namespace vispline
