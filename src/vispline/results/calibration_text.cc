#include <cmath>

#include "vispline/results/calibration_documents.h"
#include "vispline/results/people_unit.h"
#include "vispline/results/table.h"

namespace vispline {
namespace {

constexpr int kDigits = 6, kSigmaDigits = 3;

std::string full_name(const EstimatedParameter& parameter, const ParameterComponent& component) {
  return component.name.empty() ? parameter.name : parameter.name + " " + component.name;
}

/// How many sigmas off the truth.
std::string off_in_sigmas(const ParameterComponent& c) {
  if (!c.error || !c.observable()) return "-";
  return number_text(*c.error / c.sigma, 2);
}

std::string parameter_table(const CalibrationResult& result) {
  using Align = Table::Align;
  bool known = false;
  for (const EstimatedParameter& p : result.parameters) {
    for (const ParameterComponent& c : p.components) known |= c.truth.has_value();
  }
  std::vector<Table::Column> columns{{"parameter", Align::kLeft}, {"start"}, {"value"}, {"sigma"}};
  if (known) columns.insert(columns.end(), {{"truth"}, {"off [sigma]"}});
  columns.push_back({"unit", Align::kLeft});
  Table table(columns);
  for (const EstimatedParameter& p : result.parameters) {
    for (const ParameterComponent& c : p.components) {
      const PeopleUnit unit = people_unit(c.unit, p.name);
      std::vector<std::string> cells{full_name(p, c), number_text(unit.factor * c.start, kDigits),
                                     c.observable() ? number_text(unit.factor * c.value, kDigits) : "not observable",
                                     number_text(unit.factor * c.sigma, kSigmaDigits)};
      if (known) {
        cells.push_back(c.truth ? number_text(unit.factor * *c.truth, kDigits) : "-");
        cells.push_back(off_in_sigmas(c));
      }
      cells.push_back(unit.name);
      table.add_row(cells);
    }
  }
  return table.text();
}

std::string residual_table(const CalibrationResult& result) {
  Table table({{"sensor", Table::Align::kLeft},
               {"count"},
               {"rms"},
               {"sigma"},
               {"unit", Table::Align::kLeft},
               {"chi2/dof"},
               {"lag-1"},
               {"white within", Table::Align::kLeft},
               {"outliers"},
               {"lost"}});
  for (const SensorResiduals& r : result.residuals) {
    table.add_row({r.sensor, std::to_string(r.count), number_text(r.rms, 4), number_text(r.sigma, 4), r.unit,
                   number_text(r.chi2_per_dof, 4), number_text(r.lag1, 2),
                   number_text(r.lag1_low, 2) + " to " + number_text(r.lag1_high, 2), std::to_string(r.outliers),
                   std::to_string(r.lost)});
  }
  return table.text();
}

std::string stage_table(const CalibrationResult& result) {
  Table table({{"stage", Table::Align::kLeft},
               {"", Table::Align::kLeft},
               {"value"},
               {"limit"},
               {"unit", Table::Align::kLeft},
               {"what", Table::Align::kLeft}});
  for (const InitialisationStage& s : result.stages) {
    table.add_row(
        {s.name, s.passed ? "passed" : "FAILED", number_text(s.value, 4), number_text(s.limit, 4), s.unit, s.words});
  }
  return table.text();
}

std::string numbers_text(const std::vector<double>& numbers, double factor) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_text(factor * number, kSigmaDigits);
  return text;
}

std::string held_table(const CalibrationResult& result) {
  Table table({{"held", Table::Align::kLeft},
               {"free, less squares"},
               {"would move by", Table::Align::kLeft},
               {"sigma", Table::Align::kLeft},
               {"unit", Table::Align::kLeft}});
  for (const HeldParameter& held : result.held) {
    const PeopleUnit unit = people_unit(held.unit, held.name);
    table.add_row({held.name, number_text(100.0 * held.share, 2) + " %", numbers_text(held.change, unit.factor),
                   numbers_text(held.sigma, unit.factor), unit.name});
  }
  return table.text();
}

/// Sigmas beside those of the jack-knife and of the twin.
std::string spread_table(const CalibrationResult& result) {
  const auto& components = result.jackknife ? result.jackknife->components : result.twin->components;
  std::vector<Table::Column> columns{{"parameter", Table::Align::kLeft}, {"sigma"}};
  if (result.jackknife) columns.push_back({"jack-knife"});
  if (result.twin) columns.insert(columns.end(), {{"twin"}, {"in 95 %"}});
  columns.push_back({"unit", Table::Align::kLeft});
  Table table(columns);
  for (std::size_t i = 0; i < components.size(); ++i) {
    const PeopleUnit unit = people_unit(components[i].unit, components[i].label);
    std::vector<std::string> cells{components[i].label, number_text(unit.factor * components[i].sigma, kSigmaDigits)};
    if (result.jackknife) cells.push_back(number_text(unit.factor * components[i].spread, kSigmaDigits));
    if (result.twin) {
      const ComponentSpread& c = result.twin->components[i];
      cells.push_back(number_text(unit.factor * c.spread, kSigmaDigits));
      cells.push_back(number_text(100.0 * c.coverage, 3) + " %");
    }
    cells.push_back(unit.name);
    table.add_row(cells);
  }
  return table.text();
}

std::string twin_line(const Twin& twin) {
  return "twin: NEES " + number_text(twin.nees, 3) + " over " + std::to_string(twin.runs) +
         " runs, right sigmas give " + number_text(twin.nees_low, 3) + " to " + number_text(twin.nees_high, 3) +
         "; 95 % intervals hold " + number_text(100.0 * twin.coverage, 3) + " %; " + std::to_string(twin.failed) +
         " runs failed\n";
}

}  // namespace

std::string calibration_text(const CalibrationResult& result) {
  std::string text = "class: " + std::string(to_name(result.result_class)) + "\n";
  for (const std::string& reason : result.reasons) text += "  " + reason + "\n";
  if (!result.stages.empty()) text += "\n" + stage_table(result);
  if (!result.parameters.empty()) text += "\n" + parameter_table(result);
  if (result.nees) {
    text += "against the truth: NEES " + number_text(*result.nees, 3) + " of " +
            std::to_string(result.correlation.rows()) + " numbers, 1 on average if sigmas are right\n";
  }
  if (!result.residuals.empty()) text += "\n" + residual_table(result);
  if (!result.held.empty()) text += "\n" + held_table(result);
  if (!result.weak.empty()) text += "\n";
  for (const WeakDirection& weak : result.weak) {
    text += (weak.measured ? "weak: " : "not measured: ") + weak.words + "; to mend it, " + weak.remedy + "\n";
  }
  if (result.jackknife || result.twin) text += "\n" + spread_table(result);
  if (result.twin) text += twin_line(*result.twin);
  if (result.trajectory) {
    text += "\ntrajectory against the truth: " + number_text(1e3 * result.trajectory->position_m.rmse, 4) +
            " mm rms, " + number_text(result.trajectory->rotation_rmse_deg, 3) + " deg rms over " +
            std::to_string(result.trajectory->association.pairs.size()) + " poses\n";
  }
  return text;
}

}  // namespace vispline
