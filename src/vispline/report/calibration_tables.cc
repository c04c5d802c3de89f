#include "vispline/report/calibration_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vispline/report/number.h"
#include "vispline/results/people_unit.h"

namespace vispline::report {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostDigits = 9;

/// As many digits that the last one is a tenth of sigma.
std::string value_text(double value, double sigma) {
  if (!std::isfinite(value)) return "—";
  if (!(sigma > 0.0) || !std::isfinite(sigma)) return significant(value, 5);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, kMostDigits);
  return fixed_decimals(value, decimals);
}

std::string name_of(const EstimatedParameter& parameter, const ParameterComponent& component) {
  return component.name.empty() ? parameter.name : joined({parameter.name, " ", component.name});
}

bool has_truth(const CalibrationResult& result) {
  return std::ranges::any_of(result.parameters, [](const EstimatedParameter& p) {
    return std::ranges::any_of(p.components, [](const ParameterComponent& c) { return c.truth.has_value(); });
  });
}

std::vector<Cell> parameter_row(const EstimatedParameter& p, const ParameterComponent& c, bool truth) {
  const PeopleUnit unit = people_unit(c.unit, p.name);
  const double f = unit.factor, sigma = f * c.sigma;
  std::vector<Cell> row{name_of(p, c), value_text(f * c.start, sigma),
                        c.observable() ? value_text(f * c.value, sigma) : std::string("not observable"), sigma};
  if (truth) {
    row.emplace_back(c.truth ? value_text(f * *c.truth, sigma) : std::string("—"));
    row.emplace_back(c.error && c.observable() ? *c.error / c.sigma : kNone);
  }
  row.emplace_back(unit.name);
  return row;
}

Column text(const std::string& header) { return {.header = header, .unit = "", .numeric = false}; }
Column number(const std::string& header, int digits = 3) {
  return {.header = header, .unit = "", .numeric = true, .digits = digits};
}

}  // namespace

Table parameter_table(const CalibrationResult& result) {
  const bool truth = has_truth(result);
  Table table{.caption = truth ? "The start, what was found with its standard deviation, and the truth"
                               : "The start, and what was found with its standard deviation",
              .columns = {text("parameter"), number("start"), number("value"), number("sigma")}};
  if (truth) {
    table.columns.push_back(number("truth"));
    table.columns.push_back({.header = "error", .unit = "sigma", .numeric = true, .digits = 2});
  }
  table.columns.push_back(text("unit"));
  for (const EstimatedParameter& p : result.parameters) {
    for (const ParameterComponent& c : p.components) table.rows.push_back(parameter_row(p, c, truth));
  }
  return table;
}

Table residual_table(const CalibrationResult& result) {
  Table table{.caption =
                  "Residuals at the solution. χ²/dof is 1 if sigma and model are right; lag 1 is the correlation "
                  "of consecutive residuals, and white ones stay within the band",
              .columns = {text("sensor"), number("count"), number("rms"), number("sigma"), text("unit"),
                          number("χ²/dof"), number("lag 1", 2), text("band"), number("beyond 4σ"), number("lost")}};
  for (const SensorResiduals& r : result.residuals) {
    table.rows.push_back({r.sensor, r.count, r.rms, r.sigma, r.unit, r.chi2_per_dof, r.lag1,
                          joined({fixed_decimals(r.lag1_low, 3), " to ", fixed_decimals(r.lag1_high, 3)}), r.outliers,
                          r.lost});
  }
  return table;
}

Table held_table(const CalibrationResult& result) {
  Table table{.caption = "Held, though the residuals ask for them: what freeing each alone would take off all squared "
                         "residuals, and where it would go",
              .columns = {text("parameter"),
                          {.header = "less squares", .unit = "%", .numeric = true, .digits = 2},
                          text("would move by"),
                          text("unit")}};
  for (const HeldParameter& held : result.held) {
    const PeopleUnit unit = people_unit(held.unit, held.name);
    std::string moves;
    for (std::size_t i = 0; i < held.change.size(); ++i) {
      moves += joined({moves.empty() ? "" : ", ", significant(unit.factor * held.change[i], 3), " ± ",
                       significant(unit.factor * held.sigma[i], 2)});
    }
    table.rows.push_back({held.name, 100.0 * held.share, moves, unit.name});
  }
  return table;
}

Table stage_table(const CalibrationResult& result) {
  Table table{.caption = "How the start was found, and the number that each stage had to reach",
              .columns = {text("stage"), text("what"), number("value"), number("limit"), text("unit"), text("")}};
  for (const InitialisationStage& s : result.stages) {
    table.rows.push_back({s.name, s.words, s.value, s.limit, s.unit, std::string(s.passed ? "passed" : "failed")});
  }
  return table;
}

Table weak_table(const CalibrationResult& result) {
  Table table{.caption = "", .columns = {text("direction"), number("sigma over limit"), text("what to record")}};
  for (const WeakDirection& weak : result.weak) {
    table.rows.push_back({joined({weak.measured ? "" : "not measured: ", weak.words}),
                          weak.measured ? weak.sigma_limits : kNone, weak.remedy});
  }
  return table;
}

Table spread_table(const CalibrationResult& result) {
  Table table{.caption = "Standard deviations: of the information matrix, and as they were found in other ways",
              .columns = {text("parameter"), number("sigma")}};
  if (result.jackknife) table.columns.push_back(number("jack-knife"));
  if (result.twin) {
    table.columns.push_back(number("twin"));
    table.columns.push_back({.header = "in 95 % interval", .unit = "%", .numeric = true});
  }
  table.columns.push_back(text("unit"));
  const auto& components = result.jackknife ? result.jackknife->components : result.twin->components;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const PeopleUnit unit = people_unit(components[i].unit, components[i].label);
    std::vector<Cell> row{components[i].label, unit.factor * components[i].sigma};
    if (result.jackknife) row.emplace_back(unit.factor * components[i].spread);
    if (result.twin) {
      row.emplace_back(unit.factor * result.twin->components[i].spread);
      row.emplace_back(100.0 * result.twin->components[i].coverage);
    }
    row.emplace_back(unit.name);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace vispline::report
