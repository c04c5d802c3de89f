#include "vispline/estimate/assess.h"

#include <algorithm>
#include <cmath>

#include "vispline/estimate/estimated_parameters.h"
#include "vispline/estimate/gradient_check.h"
#include "vispline/estimate/held_parameters.h"
#include "vispline/estimate/observability.h"
#include "vispline/estimate/residual_statistics.h"
#include "vispline/results/table.h"

namespace vispline {
namespace {

// docs/math/uncertainty.md, Classes.
constexpr double kFarthestSigmas = 0.2;
constexpr double kLeastNormalised = 0.5, kMostNormalised = 2.0;
constexpr double kMostCondition = 1e12;
constexpr double kMostLost = 0.01;
constexpr double kLeastDof = 10.0;
constexpr double kMostCorrelated = 0.1;
constexpr double kMostDrifting = 0.5;  // of consecutive residuals that are also larger than the rig says
constexpr double kMostHeld = 0.5;     // of the squared residuals, by one parameter
constexpr double kLeastCurvature = 0.8, kMostCurvature = 1.25;

std::string text(double value) { return number_text(value, 3); }

/// As far as can be told.
bool is_white(const SensorResiduals& r) {
  return r.dof < kLeastDof || (r.lag1 >= r.lag1_low - kMostCorrelated && r.lag1 <= r.lag1_high + kMostCorrelated);
}

std::string percent(double share) { return text(100.0 * share) + " %"; }

class Judge {
 public:
  Judge(const Solution& solution, const AssessOptions& options, CalibrationResult& result)
      : solution_(solution), options_(options), result_(result) {}

  /// The first class whose rule applies.
  ResultClass judge() {
    if (solution_.status == SolveStatus::kStopped) {
      return because(ResultClass::kStopped, "stopped after " + std::to_string(result_.iterations) + " iterations");
    }
    if (!std::isfinite(solution_.cost)) {
      return because(ResultClass::kFailed, "the cost is not a finite number");
    }
    if (!solution_.full_rank) return rank_deficient();
    if (solution_.status == SolveStatus::kFailed) {
      return because(ResultClass::kFailed, "no step lowers the cost, and none is small enough to end");
    }
    if (solution_.status == SolveStatus::kIterationLimit) return at_limit();
    if (result_.gradient_sigmas > kFarthestSigmas) return off_the_minimum();
    find_inconsistencies();
    if (!result_.reasons.empty()) return ResultClass::kInconsistent;
    find_weaknesses();
    if (!result_.reasons.empty()) return ResultClass::kConvergedWeak;
    return because(ResultClass::kConverged, summary());
  }

 private:
  ResultClass because(ResultClass result_class, std::string reason) {
    result_.reasons.push_back(std::move(reason));
    return result_class;
  }

  ResultClass rank_deficient() {
    for (const WeakDirection& weak : result_.weak) result_.reasons.push_back("not measured: " + weak.words);
    return ResultClass::kRankDeficient;
  }

  ResultClass at_limit() {
    const double last = solution_.iterations.empty() ? 0.0 : solution_.iterations.back().predicted;
    return because(ResultClass::kNotConverged, std::to_string(result_.iterations) +
                                                   " iterations were not enough: the last step promised to lower the "
                                                   "cost by " +
                                                   text(last));
  }

  ResultClass off_the_minimum() {
    return because(ResultClass::kNotConverged, "gradient check: the cost is lowest " + text(result_.gradient_sigmas) +
                                                   " sigma away from a parameter, more than " + text(kFarthestSigmas));
  }

  void find_inconsistencies() {
    for (const SensorResiduals& r : result_.residuals) {
      const double normalised = std::sqrt(r.chi2_per_dof);
      if (r.dof >= kLeastDof && (normalised < kLeastNormalised || normalised > kMostNormalised)) {
        result_.reasons.push_back(r.sensor + ": residuals are " + text(normalised) +
                                  " times as large as their sigma of " + text(r.sigma) + " " + r.unit + " says");
      }
      const double louder = r.rig_sigma > 0.0 ? r.sigma / r.rig_sigma : 0.0;
      if (louder > kMostNormalised && r.lag1 > kMostDrifting) {
        result_.reasons.push_back(r.sensor + ": residuals are " + text(louder) +
                                  " times what the rig says and no noise: consecutive ones are correlated by " +
                                  text(r.lag1));
      }
      const auto readings = static_cast<double>(r.time_s.size()) + static_cast<double>(r.lost);
      if (static_cast<double>(r.lost) > kMostLost * readings) {
        result_.reasons.push_back(r.sensor + ": " + std::to_string(r.lost) + " of " + text(readings) +
                                  " readings cannot be predicted at the solution");
      }
    }
    if (!result_.held.empty() && result_.held.front().share > kMostHeld) {
      const HeldParameter& worst = result_.held.front();
      result_.reasons.push_back(worst.name + " is held; free it would take " + percent(worst.share) +
                                " off the squared residuals");
    }
    if (!options_.time_offset_bound_s) return;
    for (const EstimatedParameter& p : result_.parameters) {
      if (!p.name.ends_with("time_offset")) continue;
      const double change = std::abs(p.components[0].value - p.components[0].start);
      if (change >= *options_.time_offset_bound_s) {
        result_.reasons.push_back(p.name + " moved by " + text(1e3 * change) + " ms, to its bound of " +
                                  text(1e3 * *options_.time_offset_bound_s) + " ms");
      }
    }
  }

  void find_weaknesses() {
    for (const EstimatedParameter& p : result_.parameters) {
      for (const ParameterComponent& c : p.components) {
        if (c.observable()) continue;
        result_.reasons.push_back(p.name + (c.name.empty() ? "" : " " + c.name) + " is not observable: sigma " +
                                  text(c.sigma) + " " + c.unit + ", limit " + text(c.limit) + " " + c.unit);
      }
    }
    if (result_.condition > kMostCondition) {
      result_.reasons.push_back("condition of the parameters " + text(result_.condition) + ", more than " +
                                text(kMostCondition));
    }
  }

  std::string summary() const {
    std::string coloured;
    for (const SensorResiduals& r : result_.residuals) {
      if (!is_white(r)) coloured += (coloured.empty() ? "" : ", ") + r.sensor;
    }
    const std::string but =
        coloured.empty() ? "" : "; but those of " + coloured + " are not white, so that sigmas are too small";
    return "tolerance met after " + std::to_string(result_.iterations) + " iterations; lowest cost within " +
           text(result_.gradient_sigmas) +
           " sigma of every parameter; full rank; residuals as large as their sigmas say" + but;
  }

  const Solution& solution_;
  const AssessOptions& options_;
  CalibrationResult& result_;
};

std::string remedy_of(const std::string& sensor) {
  const std::string closer = "knots closer together, or ";
  if (sensor.ends_with(".accelerometer")) {
    return closer + "a model with what it lacks: --bias-walk 1, --free " + sensor + ".time_offset";
  }
  if (sensor.ends_with(".gyroscope")) return closer + "a bias that walks: --bias-walk 1";
  if (sensor.starts_with("reference")) return closer + "poses that were not smoothed";
  return closer + "another model of the lens: --free " + sensor + ".intrinsics";
}

void warn_of_held(CalibrationResult& result) {
  constexpr std::size_t kMost = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMost, result.held.size()); ++i) {
    names += (names.empty() ? "" : ", ") + result.held[i].name + " (" + percent(result.held[i].share) + ")";
  }
  if (names.empty()) return;
  result.diagnostics.add({.code = "W-HELD",
                          .message = "held, but free would take so much off the squared residuals: " + names,
                          .where = "",
                          .effect = "what is estimated bends to the values they are held at",
                          .next = "--free " + result.held.front().name + ", or hold it at a better value"});
}

void warn(CalibrationResult& result) {
  for (const SensorResiduals& r : result.residuals) {
    if (!is_white(r)) {
      result.diagnostics.add({.code = "W-NOT-WHITE",
                              .message = r.sensor + ": consecutive residuals are correlated by " + text(r.lag1) +
                                         ", white ones would be between " + text(r.lag1_low) + " and " +
                                         text(r.lag1_high),
                              .where = "",
                              .effect = "the sigmas are smaller than the errors",
                              .next = remedy_of(r.sensor)});
    }
  }
  for (const SensorResiduals& r : result.residuals) {
    const double ratio = r.rig_sigma > 0.0 ? r.sigma / r.rig_sigma : 1.0;
    if (ratio > 1.0 / kMostNormalised && ratio < kMostNormalised) continue;
    result.diagnostics.add({.code = "W-NOISE",
                            .message = r.sensor + ": noise of " + text(r.sigma) + " " + r.unit + ", " + text(ratio) +
                                       " times what the rig says",
                            .where = "",
                            .effect = "the one of the recording was used",
                            .next = "measure the noise of the still sensor: vispline allan"});
  }
  if (result.curvature_low < kLeastCurvature || result.curvature_high > kMostCurvature) {
    result.diagnostics.add({.code = "W-CURVATURE",
                            .message = "half a sigma away the cost rises " + text(result.curvature_low) + " to " +
                                       text(result.curvature_high) + " times as fast as the sigmas say",
                            .where = "",
                            .effect = "sigmas are rough",
                            .next = "compare with those of the twin"});
  }
}

}  // namespace

CalibrationResult assess(const Problem& problem, const Solution& solution, const AssessOptions& options) {
  CalibrationResult result;
  result.first_cost = solution.first_cost;
  result.cost = solution.cost;
  result.iterations = static_cast<int>(solution.iterations.size());
  report_parameters(options.start ? *options.start : problem.start, solution, options.truth, result);
  if (std::isfinite(solution.cost)) {
    require(solution.equations != nullptr, "a solution with covariance");
    const NormalEquations& equations = *solution.equations;
    result.residuals = residual_statistics(problem, solution, equations, options.threads);
    result.weak = solution.full_rank ? weak_directions(solution) : null_directions(solution, equations);
    if (options.check_gradient) {
      const GradientCheck check = check_gradient(problem, solution, equations, options.threads);
      result.gradient_sigmas = check.farthest_sigmas;
      result.curvature_low = check.curvature_low;
      result.curvature_high = check.curvature_high;
    }
    if (solution.full_rank) result.held = held_parameters(problem, solution, options.threads);
    warn(result);
    warn_of_held(result);
  }
  result.result_class = Judge(solution, options, result).judge();
  return result;
}

}  // namespace vispline
