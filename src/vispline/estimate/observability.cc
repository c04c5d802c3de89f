#include "vispline/estimate/observability.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "vispline/estimate/parameter_kind.h"
#include "vispline/results/people_unit.h"
#include "vispline/results/table.h"

namespace vispline {
namespace {

using Component = NamedComponent;

std::vector<Component> components_of(const Solution& solution) {
  return named_components(solution.parameters, solution.state);
}

Eigen::VectorXd limits_of(const std::vector<Component>& components) {
  Eigen::VectorXd limits(static_cast<Eigen::Index>(components.size()));
  for (Eigen::Index i = 0; i < limits.size(); ++i) limits(i) = components[static_cast<std::size_t>(i)].kind.limit;
  return limits;
}

std::string amount(double si, const Component& c) {
  const PeopleUnit unit = people_unit(c.kind.unit, c.parameter);
  return number_text(unit.factor * std::abs(si), 2) + (unit.name == "1" ? "" : " " + unit.name);
}

/// "cam0.T_c_i.translation along y" of the components from `begin` on of one parameter, and ": 41 mm".
std::pair<std::string, std::string> words_of(const std::vector<Component>& components, Eigen::Index begin,
                                             const Eigen::VectorXd& part) {
  const Component& first = components[static_cast<std::size_t>(begin)];
  Eigen::Index main = 0;
  const Eigen::VectorXd block = part.segment(begin, first.size);
  block.cwiseAbs().maxCoeff(&main);
  const Component& largest = components[static_cast<std::size_t>(begin + main)];
  if (first.size == 1) return {first.parameter, ": " + amount(block(0), first)};
  if (first.size != 3) return {largest.label(), ": " + amount(block(main), largest)};
  const Eigen::VectorXd u = block.normalized();
  const char* how = first.parameter.ends_with("rotation") ? " about " : " along ";
  std::string axis = largest.kind.name;
  if (std::abs(u(main)) < 0.9) {
    axis = "(" + number_text(u(0), 1) + ", " + number_text(u(1), 1) + ", " + number_text(u(2), 1) + ")";
  }
  return {first.parameter + how + axis, ": " + amount(block.norm(), first)};
}

/// `part`: the direction in the units of the components.
WeakDirection direction(const std::vector<Component>& components, const Eigen::VectorXd& part, bool measured) {
  constexpr double kNamed = 0.3;  // of the largest
  const Eigen::VectorXd share = part.cwiseAbs().cwiseQuotient(limits_of(components));
  Eigen::Index main = 0;
  WeakDirection weak;
  weak.measured = measured;
  weak.sigma_limits = share.maxCoeff(&main);
  weak.remedy = components[static_cast<std::size_t>(main)].kind.remedy;
  for (Eigen::Index begin = 0; begin < part.size();) {
    const int size = components[static_cast<std::size_t>(begin)].size;
    if (share.segment(begin, size).maxCoeff() >= kNamed * weak.sigma_limits) {
      const auto [what, how_much] = words_of(components, begin, part);
      weak.words += (weak.words.empty() ? "" : " together with ") + what + (measured ? how_much : "");
    }
    for (Eigen::Index i = begin; i < begin + size; ++i) {
      if (share(i) < kNamed * weak.sigma_limits) continue;
      weak.part.emplace_back(components[static_cast<std::size_t>(i)].label(), part(i));
    }
    begin += size;
  }
  return weak;
}

/// Columns that span the same, each with as many zeros as can be: elimination with the largest entry as pivot.
Eigen::MatrixXd sparse_basis(Eigen::MatrixXd basis) {
  for (Eigen::Index c = 0; c < basis.cols(); ++c) {
    Eigen::Index row = 0;
    basis.col(c).cwiseAbs().maxCoeff(&row);
    for (Eigen::Index other = 0; other < basis.cols(); ++other) {
      if (other != c) basis.col(other) -= basis(row, other) / basis(row, c) * basis.col(c);
    }
  }
  basis.colwise().normalize();
  return basis;
}

WeakDirection outside_parameters() {
  return {false,
          "the trajectory or a landmark itself",
          "measure what holds it: position and heading of the start, stretches without samples, landmarks seen once",
          0.0,
          {}};
}

}  // namespace

std::vector<WeakDirection> weak_directions(const Solution& solution) {
  std::vector<WeakDirection> weak;
  if (solution.covariance.size() == 0) return weak;
  const std::vector<Component> components = components_of(solution);
  const Eigen::VectorXd limits = limits_of(components);
  const Eigen::MatrixXd scaled =
      limits.cwiseInverse().asDiagonal() * solution.covariance * limits.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  for (Eigen::Index i = scaled.cols() - 1; i >= 0 && eigen.eigenvalues()(i) > 1.0; --i) {
    const Eigen::VectorXd part = std::sqrt(eigen.eigenvalues()(i)) * limits.cwiseProduct(eigen.eigenvectors().col(i));
    weak.push_back(direction(components, part, true));
  }
  return weak;
}

std::vector<WeakDirection> null_directions(const Solution& solution, const NormalEquations& equations) {
  constexpr double kShare = 1e-4;  // of 1 / lambda: the rest of the direction may lie in the trajectory
  const int n = solution.columns.layout.parameters();
  for (double lambda = 1e-10; lambda < 1e-3; lambda *= 100.0) {
    const auto covariance = equations.damped_covariance(n, lambda);
    if (!covariance) continue;
    const std::vector<Component> components = components_of(solution);
    const Eigen::VectorXd root = equations.diagonal().tail(n).cwiseMax(NormalEquations::kLeastInformation).cwiseSqrt();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(root.asDiagonal() * *covariance * root.asDiagonal());
    Eigen::Index count = 0;
    while (count < n && eigen.eigenvalues()(n - 1 - count) > kShare / lambda) ++count;
    const Eigen::MatrixXd basis = sparse_basis(eigen.eigenvectors().rightCols(count));
    std::vector<WeakDirection> found;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::VectorXd part = basis.col(i).cwiseQuotient(root);
      // No size is wrong: the direction as far as its first component reaches its limit.
      const double scale = part.cwiseAbs().cwiseQuotient(limits_of(components)).maxCoeff();
      found.push_back(direction(components, part / scale, false));
      found.back().sigma_limits = std::numeric_limits<double>::infinity();
    }
    if (found.empty()) found.push_back(outside_parameters());
    return found;
  }
  return {outside_parameters()};
}

}  // namespace vispline
