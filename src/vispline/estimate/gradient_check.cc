#include "vispline/estimate/gradient_check.h"

#include <algorithm>
#include <cmath>

namespace vispline {
namespace {

constexpr double kStepSigmas = 0.5;

/// One sigma of all numbers of a parameter at once, with the signs of their correlation.
Eigen::MatrixXd pushes(const Solution& solution) {
  const int first = solution.columns.layout.first_parameter;
  Eigen::MatrixXd push(solution.columns.layout.columns, 0);
  for (const Parameter& parameter : solution.parameters) {
    if (parameter.column < 0) continue;
    push.conservativeResize(Eigen::NoChange, push.cols() + 1);
    push.rightCols<1>().setZero();
    Eigen::VectorXd b(parameter.size);
    for (int k = 0; k < parameter.size; ++k) {
      const Eigen::Index i = parameter.column - first + k;
      b(k) = 1.0 / std::sqrt(solution.covariance(i, i));
    }
    const auto block =
        solution.covariance.block(parameter.column - first, parameter.column - first, parameter.size, parameter.size);
    push.rightCols<1>().segment(parameter.column, parameter.size) = b / std::sqrt(b.dot(block * b));
  }
  return push;
}

}  // namespace

GradientCheck check_gradient(const Problem& problem, const Solution& solution, const NormalEquations& equations,
                             std::size_t threads) {
  GradientCheck check;
  if (solution.covariance.size() == 0) return check;
  bool first = true;
  for (const Step& step : equations.respond(pushes(solution))) {
    const auto cost = [&](double sigmas) {
      std::vector<Vector3d> landmarks = step.delta_landmark;
      for (Vector3d& delta : landmarks) delta *= sigmas;
      const State there =
          moved(solution.state, solution.columns, solution.parameters, sigmas * step.delta, problem, landmarks);
      return cost_at(problem, there, solution.columns, threads).cost;
    };
    const double after = cost(kStepSigmas), before = cost(-kStepSigmas);
    const double slope = (after - before) / (2.0 * kStepSigmas);
    const double curvature = (after - 2.0 * equations.cost() + before) / (kStepSigmas * kStepSigmas);
    check.farthest_sigmas = std::max(check.farthest_sigmas, std::abs(slope));
    check.curvature_low = first ? curvature : std::min(check.curvature_low, curvature);
    check.curvature_high = first ? curvature : std::max(check.curvature_high, curvature);
    first = false;
  }
  return check;
}

}  // namespace vispline
