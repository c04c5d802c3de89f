#include "vispline/estimate/estimated_parameters.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "vispline/estimate/parameter_kind.h"
#include "vispline/estimate/plane_across.h"

namespace vispline {
namespace {

/// d value / d perturbation: the identity, but for a unit vector, which has fewer directions than coordinates.
Eigen::MatrixXd value_by_perturbation(const Parameter& parameter, const State& state) {
  if (parameter.value(state).size() == parameter.size) return Eigen::MatrixXd::Identity(parameter.size, parameter.size);
  return plane_across(state.g_w);
}

std::string whole_unit(const std::vector<ComponentKind>& kinds) {
  for (const ComponentKind& kind : kinds) {
    if (kind.unit != kinds.front().unit) return "px, 1";
  }
  return kinds.front().unit;
}

class Reporter {
 public:
  Reporter(const State& start, const Solution& solution, const State* truth)
      : start_(start), solution_(solution), truth_(truth) {}

  EstimatedParameter report(const Parameter& parameter) const {
    const std::vector<ComponentKind> kinds = component_kinds(parameter, solution_.state);
    EstimatedParameter out;
    out.name = reported_name(parameter.name, solution_.state);
    out.unit = whole_unit(kinds);
    if (parameter.treatment.role == Role::kPrior) out.prior_sigma = parameter.treatment.sigma;
    const Eigen::VectorXd value = parameter.value(solution_.state), start = parameter.value(start_);
    const Eigen::MatrixXd B = value_by_perturbation(parameter, solution_.state);
    const Eigen::VectorXd sigma = sigma_of(parameter, B);
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      const bool same = value.size() == parameter.size;
      const ComponentKind& kind = kinds[same ? static_cast<std::size_t>(k) : 0];
      out.components.push_back({same ? kind.name : std::string(1, "xyz"[k]), kind.unit, value(k), start(k), sigma(k),
                                kind.limit, std::nullopt, std::nullopt});
    }
    if (truth_) compare(parameter, B, out);
    return out;
  }

 private:
  Eigen::VectorXd sigma_of(const Parameter& parameter, const Eigen::MatrixXd& B) const {
    if (solution_.covariance.size() == 0) {
      return Eigen::VectorXd::Constant(B.rows(), std::numeric_limits<double>::infinity());
    }
    const Eigen::Index at = parameter.column - solution_.columns.layout.first_parameter;
    const auto block = solution_.covariance.block(at, at, parameter.size, parameter.size);
    return (B * block * B.transpose()).diagonal().cwiseSqrt();
  }

  void compare(const Parameter& parameter, const Eigen::MatrixXd& B, EstimatedParameter& out) const {
    const Eigen::VectorXd value = parameter.value(*truth_);
    const Eigen::VectorXd error = -(B * parameter.delta(solution_.state, *truth_));
    for (Eigen::Index k = 0; k < value.size(); ++k) {
      out.components[static_cast<std::size_t>(k)].truth = value(k);
      out.components[static_cast<std::size_t>(k)].error = error(k);
    }
  }

  const State& start_;
  const Solution& solution_;
  const State* truth_;
};

/// Of right sigmas and correlations 1 on average.
void report_nees(const Solution& solution, const State& truth, CalibrationResult& result) {
  if (solution.covariance.size() == 0) return;
  Eigen::VectorXd error(solution.covariance.rows());
  for (const Parameter& parameter : solution.parameters) {
    if (parameter.column < 0) continue;
    error.segment(parameter.column - solution.columns.layout.first_parameter, parameter.size) =
        parameter.delta(solution.state, truth);
  }
  result.nees = error.dot(solution.covariance.ldlt().solve(error)) / static_cast<double>(error.size());
}

void report_correlation(const Solution& solution, CalibrationResult& result) {
  for (const NamedComponent& component : named_components(solution.parameters, solution.state)) {
    result.correlation_labels.push_back(component.label());
  }
  if (solution.covariance.size() == 0) return;
  const Eigen::VectorXd scale = solution.covariance.diagonal().cwiseSqrt().cwiseInverse();
  result.correlation = scale.asDiagonal() * solution.covariance * scale.asDiagonal();
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(result.correlation, Eigen::EigenvaluesOnly).eigenvalues();
  const double least = eigenvalues(0), most = eigenvalues(eigenvalues.size() - 1);
  result.condition = least > 0.0 ? most / least : std::numeric_limits<double>::infinity();
}

}  // namespace

void report_parameters(const State& start, const Solution& solution, const State* truth, CalibrationResult& result) {
  const Reporter reporter(start, solution, truth);
  for (const Parameter& parameter : solution.parameters) {
    if (parameter.column < 0) {
      result.fixed.push_back(reported_name(parameter.name, solution.state));
    } else {
      result.parameters.push_back(reporter.report(parameter));
    }
  }
  report_correlation(solution, result);
  if (truth) report_nees(solution, *truth, result);
}

}  // namespace vispline
