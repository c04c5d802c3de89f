#include <array>

#include "vispline/results/allan_documents.h"
#include "vispline/results/allan_summary.h"
#include "vispline/results/allan_words.h"
#include "vispline/results/table.h"

namespace vispline {
namespace {

constexpr std::array kMainTerms{Term::kWhite, Term::kRandomWalk, Term::kFlicker};

std::string in_brackets(const std::string& unit) { return unit.empty() ? "" : " [" + unit + "]"; }
std::string plural(std::int64_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

/// "1.70e-04 -0.57 +0.75 %" or "< 3.10e-06" or "-".
std::string cell(const TermEstimate& e) {
  if (!e.resolved) return e.upper_bound ? "< " + scientific_text(e.upper_bound) : "-";
  const double down = 100.0 * (1.0 - e.low_95 / e.value), up = 100.0 * (e.high_95 / e.value - 1.0);
  return scientific_text(e.value) + " -" + percent_text(down) + " +" + percent_text(up) + " %";
}

/// N, K, B, and what else some axis resolves.
std::vector<Term> columns_of(const SensorSummary& sensor) {
  std::vector<Term> terms(kMainTerms.begin(), kMainTerms.end());
  for (const Term term : {Term::kQuantization, Term::kRamp}) {
    if (!sensor[term].resolved_axes.empty()) terms.push_back(term);
  }
  return terms;
}

std::string mean_cell(const TermSummary& summary) {
  if (!summary.mean || summary.resolved()) return scientific_text(summary.mean);
  std::string axes;
  for (const std::string& axis : summary.resolved_axes) axes += axes.empty() ? axis : " " + axis;
  return scientific_text(summary.mean) + " of " + axes;
}

std::string worst_cell(const TermSummary& summary) {
  const auto limit = summary.limit();
  if (limit && limit != summary.worst) return "< " + scientific_text(limit);
  if (!summary.worst) return "-";
  return scientific_text(summary.worst) + (summary.worst_axis.empty() ? "" : " (" + summary.worst_axis + ")");
}

Table table_of(const SensorSummary& sensor) {
  std::vector<Table::Column> columns{{sensor.sensor, Table::Align::kLeft}};
  for (const Term term : columns_of(sensor)) {
    columns.push_back({std::string(symbol_of(term)) + in_brackets(unit_of(term, sensor.unit)), Table::Align::kLeft});
  }
  columns.push_back({"minimum" + in_brackets(sensor.unit)});
  columns.push_back({"at tau [s]"});
  return Table(columns);
}

void add_axis(Table& table, const SensorSummary& sensor, const SignalAnalysis& signal) {
  std::vector<std::string> cells{signal.axis};
  for (const Term term : columns_of(sensor)) cells.push_back(signal.constant ? "constant" : cell(signal.terms[term]));
  const bool found = signal.minimum.tau_s > 0.0;
  cells.push_back(found ? scientific_text(signal.minimum.deviation) : "-");
  cells.push_back(found ? number_text(signal.minimum.tau_s, 4) : "-");
  table.add_row(cells);
}

void add_row(Table& table, const SensorSummary& sensor, const char* name, std::string (*cell_of)(const TermSummary&)) {
  std::vector<std::string> cells{name};
  for (const Term term : columns_of(sensor)) cells.push_back(cell_of(sensor[term]));
  cells.insert(cells.end(), {"", ""});
  table.add_row(cells);
}

std::string sensor_text(const AllanResult& result, const SensorSummary& sensor) {
  Table table = table_of(sensor);
  for (const std::size_t i : sensor.signals) add_axis(table, sensor, result.signals[i]);
  if (sensor.signals.size() > 1) {
    add_row(table, sensor, "mean", mean_cell);
    add_row(table, sensor, "worst", worst_cell);
  }
  return "\n" + table.text();
}

/// Kalibr's four numbers, and beside each what it is as a standard deviation at this rate.
std::string quantities_text(const AllanResult& result, const std::vector<SensorSummary>& sensors) {
  const std::string rate = number_text(result.rate_hz, 6) + " Hz";
  Table table({{"quantity", Table::Align::kLeft},
               {"mean"},
               {"worst", Table::Align::kLeft},
               {"unit", Table::Align::kLeft},
               {"sigma at " + rate},
               {"unit", Table::Align::kLeft}});
  for (const SensorSummary& sensor : sensors) {
    for (const Term term : {Term::kWhite, Term::kRandomWalk}) {
      const TermSummary& s = sensor[term];
      const bool white = term == Term::kWhite;
      const auto sigma = discrete_sigma(term, s.mean, result.rate_hz);
      const std::string unit = sensor.unit + (sensor.unit.empty() ? "= " : " = ");
      table.add_row({quantity_name(sensor.sensor, term), scientific_text(s.mean), worst_cell(s),
                     unit_of(term, sensor.unit), scientific_text(sigma),
                     unit + (white ? "N sqrt(rate)" : "K / sqrt(rate), per step")});
    }
  }
  return "\n" + table.text();
}

std::string unresolved_lines(const AllanResult& result, const std::vector<SensorSummary>& sensors) {
  std::string text;
  for (const SensorSummary& sensor : sensors) {
    for (const Term term : unresolved_terms(result, sensor)) text += unresolved_text(sensor, term) + "\n";
  }
  return text.empty() ? "" : "\n" + text;
}

std::string imu_utils_text(const AllanResult& result, const std::vector<SensorSummary>& sensors) {
  std::string numbers;
  for (const SensorSummary& sensor : sensors) {
    if (!sensor.imu_utils_n && !sensor.imu_utils_w) continue;
    const std::string name = sensor.sensor == "gyroscope" ? "gyr" : sensor.sensor == "accelerometer" ? "acc" : "series";
    numbers += (numbers.empty() ? "" : ", ") + name + "_n " + scientific_text(sensor.imu_utils_n) + ", " + name +
               "_w " + scientific_text(sensor.imu_utils_w);
    if (!sensor.unit.empty()) numbers += " " + sensor.unit;
  }
  if (numbers.empty()) return "";
  return "\nimu_utils would print " + numbers + " (average over the axes).\n" +
         "Its n is the sigma of one sample, N sqrt(rate) at " + number_text(result.rate_hz, 6) +
         " Hz, not N. Its w is the lowest point of its fitted curve,\nsqrt(2 N K / sqrt 3) if there is only white "
         "noise and random walk: not a random walk. Do not paste either into Kalibr.\n";
}

}  // namespace

std::string allan_text(const AllanResult& result) {
  const std::vector<SensorSummary> sensors = summarize(result);
  std::string text = "record  " + duration_text(result.duration_s) + " (" + number_text(result.duration_s, 7) +
                     " s) at " + number_text(result.rate_hz, 6) + " Hz, " + plural(result.samples, "sample") + " in " +
                     plural(result.segments, "segment") + "; values with 95 % intervals, < is a 95 % bound\n";
  for (const SensorSummary& sensor : sensors) text += sensor_text(result, sensor);
  return text + quantities_text(result, sensors) + unresolved_lines(result, sensors) + imu_utils_text(result, sensors);
}

}  // namespace vispline
