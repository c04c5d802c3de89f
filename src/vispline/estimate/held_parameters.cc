#include "vispline/estimate/held_parameters.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "vispline/estimate/normal_equations.h"

namespace vispline {
namespace {

constexpr double kLeastGain = 25.0;      // of chi-square: five sigmas of a single number
constexpr double kLeastShare = 0.005;    // of all of it
constexpr double kLeastResolved = 1e-6;  // of its information when all else is known
constexpr double kDamping = 1e-10;       // what the others absorb whole has no information left

using Tail = NormalEquations::Tail;

/// Information and gradient of `wanted`, absorbed by `others` as well.
Tail absorbed(const Tail& all, const std::vector<int>& wanted, const std::vector<int>& others) {
  if (others.empty()) return {all.information(wanted, wanted), all.gradient(wanted)};
  const Eigen::MatrixXd across = all.information(others, wanted);
  const Eigen::LDLT<Eigen::MatrixXd> known(all.information(others, others));
  return {all.information(wanted, wanted) - across.transpose() * known.solve(across),
          all.gradient(wanted) - across.transpose() * known.solve(Eigen::VectorXd(all.gradient(others)))};
}

/// `alone`: the information when all else is known. Of numbers that go with others, or with each other, nothing is
/// left.
bool resolved(const Eigen::MatrixXd& left, const Eigen::VectorXd& alone) {
  const Eigen::VectorXd least = (kLeastResolved * alone).cwiseMax(NormalEquations::kLeastInformation);
  if ((left.diagonal().array() <= least.array()).any()) return false;
  const Eigen::VectorXd scale = left.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Eigen::MatrixXd> scaled(scale.asDiagonal() * left * scale.asDiagonal());
  return scaled.vectorD().minCoeff() > kLeastResolved;
}

bool is_held(const Parameter& parameter) { return parameter.treatment.role == Role::kFixed; }

std::vector<int> columns_of(const Parameter& parameter, int first) {
  std::vector<int> columns;
  for (int i = 0; i < parameter.size; ++i) columns.push_back(parameter.column - first + i);
  return columns;
}

}  // namespace

std::vector<HeldParameter> held_parameters(const Problem& problem, const Solution& solution, std::size_t threads) {
  std::vector<Parameter> all = solution.parameters;
  for (Parameter& parameter : all) parameter.treatment.role = Role::kFree;
  const Columns columns = assign_columns(solution.state, all);
  const NormalEquations equations(problem, solution.state, columns, threads);
  const int n = columns.layout.parameters(), first = columns.layout.first_parameter;
  const auto tail = equations.tail(n, kDamping);
  std::vector<HeldParameter> held;
  if (!tail) return held;
  std::vector<int> free, fixed;
  for (std::size_t p = 0; p < all.size(); ++p) {
    const std::vector<int> own = columns_of(all[p], first);
    std::vector<int>& role = is_held(solution.parameters[p]) ? fixed : free;
    role.insert(role.end(), own.begin(), own.end());
  }
  if (fixed.empty()) return held;
  const Tail left = absorbed(*tail, fixed, free);
  const Eigen::VectorXd alone = equations.diagonal().tail(n)(fixed);
  Eigen::Index next = 0;
  for (std::size_t p = 0; p < all.size(); ++p) {
    if (!is_held(solution.parameters[p])) continue;
    const Eigen::Index size = all[p].size, begin = std::exchange(next, next + size);
    const Eigen::MatrixXd information = left.information.block(begin, begin, size, size);
    const Eigen::VectorXd gradient = left.gradient.segment(begin, size);
    if (!resolved(information, alone.segment(begin, size))) continue;
    const Eigen::MatrixXd covariance = information.inverse();
    const Eigen::VectorXd change = -covariance * gradient;
    const double gain = -change.dot(gradient), share = gain / (2.0 * solution.cost);
    if (!(gain > kLeastGain && share > kLeastShare)) continue;
    const Eigen::VectorXd sigma = covariance.diagonal().cwiseSqrt();
    held.push_back({all[p].name, all[p].unit, share, {change.begin(), change.end()}, {sigma.begin(), sigma.end()}});
  }
  std::sort(held.begin(), held.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  return held;
}

}  // namespace vispline
