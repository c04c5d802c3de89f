#include "vispline/report/allan_tables.h"

#include <cmath>

#include "vispline/report/allan_plots.h"
#include "vispline/report/number.h"
#include "vispline/results/allan_words.h"

namespace vispline::report {
namespace {

constexpr std::array kOrder{Term::kWhite, Term::kRandomWalk, Term::kFlicker, Term::kQuantization, Term::kRamp};
constexpr int kDigits = 3;

/// With no-break spaces inside the brackets.
std::string cell(const TermEstimate& e) {
  if (!e.resolved) return e.upper_bound ? joined({"< ", significant(*e.upper_bound, kDigits)}) : "—";
  const double down = 100.0 * (1.0 - e.low_95 / e.value), up = 100.0 * (e.high_95 / e.value - 1.0);
  return joined({significant(e.value, kDigits), " (−", percent_text(down), "\u00a0+", percent_text(up), "\u00a0%)"});
}

/// "1.70e-04", empty if there is none, so that a spreadsheet reads a blank and not a word.
std::string tsv(bool present, double value) { return present ? scientific_text(value, 4) : ""; }

}  // namespace

std::string words_of(Term term) {
  constexpr std::array<const char*, kTerms> kWords{"quantization", "white noise density", "bias instability",
                                                   "bias random walk", "rate ramp"};
  return joined({kWords[static_cast<std::size_t>(term)], " ", symbol_of(term)});
}

std::string plain_number(double value) {
  std::string text = significant(value, 6);
  if (text.find('.') == std::string::npos || text.find('e') != std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

Table terms_table(const AllanResult& result, const SensorSummary& sensor) {
  Table table;
  table.caption =
      "Coefficients in continuous time with 95 % intervals; < is a 95 % bound of what the record cannot show";
  table.columns.push_back({.header = "term", .unit = "", .numeric = false});
  for (const std::size_t i : sensor.signals) {
    const std::string& axis = result.signals[i].axis;
    table.columns.push_back({.header = axis.empty() ? "value" : axis, .unit = "", .numeric = false});
  }
  table.columns.push_back({.header = "unit", .unit = "", .numeric = false});
  for (const Term term : kOrder) {
    table.rows.push_back({words_of(term)});
    for (const std::size_t i : sensor.signals) {
      const SignalAnalysis& signal = result.signals[i];
      table.rows.back().emplace_back(signal.constant ? std::string("constant") : cell(signal.terms[term]));
    }
    table.rows.back().emplace_back(pretty_unit(unit_of(term, sensor.unit)));
  }
  return table;
}

Table quantities_table(const AllanResult& result, const SensorSummary& sensor) {
  Table table;
  table.caption = joined({"Over the axes that resolve it, and the standard deviation that the mean gives at ",
                          plain_number(result.rate_hz), " Hz: of one sample for N, of one step of the bias for K"});
  table.columns = {{.header = "quantity", .unit = "", .numeric = false},
                   {.header = "mean", .unit = "", .numeric = true, .digits = kDigits},
                   {.header = "worst", .unit = "", .numeric = true, .digits = kDigits},
                   {.header = "bound", .unit = "other axes", .numeric = true, .digits = kDigits},
                   {.header = "unit", .unit = "", .numeric = false},
                   {.header = joined({"sigma at ", plain_number(result.rate_hz), " Hz"}),
                    .unit = pretty_unit(sensor.unit),
                    .numeric = true,
                    .digits = kDigits}};
  for (const Term term : {Term::kWhite, Term::kRandomWalk}) {
    const TermSummary& s = sensor[term];
    const auto sigma = discrete_sigma(term, s.mean, result.rate_hz);
    const auto number = [](const std::optional<double>& v) { return Cell(v.value_or(std::nan(""))); };
    table.rows.push_back({quantity_name(sensor.sensor, term), number(s.mean), number(s.worst), number(s.upper_bound),
                          pretty_unit(unit_of(term, sensor.unit)), number(sigma)});
  }
  return table;
}

Table imu_utils_table(const std::vector<SensorSummary>& sensors, double rate_hz) {
  Table table;
  table.caption = "Averages over the axes";
  table.columns = {{.header = "sensor", .unit = "", .numeric = false},
                   {.header = "n", .unit = "imu_utils", .numeric = true, .digits = kDigits},
                   {.header = "N √rate", .unit = "", .numeric = true, .digits = kDigits},
                   {.header = "w", .unit = "imu_utils", .numeric = true, .digits = kDigits},
                   {.header = "√(2NK/√3)", .unit = "", .numeric = true, .digits = kDigits},
                   {.header = "unit", .unit = "", .numeric = false}};
  for (const SensorSummary& sensor : sensors) {
    if (!sensor.imu_utils_n && !sensor.imu_utils_w) continue;
    const auto N = sensor[Term::kWhite].mean, K = sensor[Term::kRandomWalk].mean;
    const double nan = std::nan("");
    table.rows.push_back({sensor.sensor, sensor.imu_utils_n.value_or(nan),
                          discrete_sigma(Term::kWhite, N, rate_hz).value_or(nan), sensor.imu_utils_w.value_or(nan),
                          N && K ? std::sqrt(2.0 * *N * *K / std::sqrt(3.0)) : nan, pretty_unit(sensor.unit)});
  }
  return table;
}

std::string tsv_text(const AllanResult& result) {
  std::string text = "sensor\taxis\tunit";
  for (const Term term : kOrder) {
    for (const char* column : {"", " low", " high", " bound"}) text += joined({"\t", symbol_of(term), column});
  }
  for (const SignalAnalysis& signal : result.signals) {
    text += joined({"\n", signal.sensor, "\t", signal.axis, "\t", signal.unit});
    for (const Term term : kOrder) {
      const TermEstimate& e = signal.terms[term];
      for (const double value : {e.value, e.low_95, e.high_95}) text += "\t" + tsv(e.resolved, value);
      text += "\t" + tsv(!e.resolved && e.upper_bound, e.upper_bound.value_or(0.0));
    }
  }
  return text + "\n";
}

}  // namespace vispline::report
