#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "vispline/results/allan_documents.h"
#include "vispline/results/allan_words.h"

namespace vispline {
namespace {

/// The shortest text that reads back equal; empty if the value is not finite.
std::string shortest(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

/// Whether the terms' Allan deviation is what this kind measures.
bool has_fit(Deviation kind) {
  return kind == Deviation::kOadev || kind == Deviation::kAdev || kind == Deviation::kTotdev;
}

/// One curve of one signal, read once from the front as the rows go by.
struct Column {
  const SignalAnalysis* signal;
  const AllanCurve* curve;
  std::size_t next = 0;
};

std::vector<Column> columns_of(const AllanResult& result) {
  std::vector<Column> columns;
  for (const SignalAnalysis& signal : result.signals) {
    for (const AllanCurve& curve : signal.curves) columns.push_back({&signal, &curve});
  }
  return columns;
}

std::vector<double> all_taus(const std::vector<Column>& columns) {
  std::vector<double> taus;
  for (const Column& column : columns) {
    taus.insert(taus.end(), column.curve->tau_s.begin(), column.curve->tau_s.end());
  }
  std::sort(taus.begin(), taus.end());
  taus.erase(std::unique(taus.begin(), taus.end()), taus.end());
  return taus;
}

std::string header_of(const Column& column) {
  const SignalAnalysis& signal = *column.signal;
  const Deviation kind = column.curve->deviation;
  const std::string name =
      signal.sensor + (signal.axis.empty() ? "" : "_" + signal.axis) + "_" + std::string(name_of(kind));
  const std::string unit = curve_unit(kind, signal.unit);
  const std::string suffix = unit.empty() ? "" : " [" + unit + "]";
  std::string text = "," + name + suffix + "," + name + "_low" + suffix + "," + name + "_high" + suffix;
  text += "," + name + "_count";
  return has_fit(kind) ? text + "," + name + "_fit" + suffix : text;
}

std::string cells_of(Column& column, double tau_s) {
  const AllanCurve& curve = *column.curve;
  const bool fit = has_fit(curve.deviation);
  const std::size_t i = column.next;
  if (i == curve.tau_s.size() || curve.tau_s[i] != tau_s) return fit ? ",,,,," : ",,,,";
  ++column.next;
  std::string text = "," + shortest(curve.value[i]) + "," + shortest(curve.low[i]) + "," + shortest(curve.high[i]);
  text += "," + std::to_string(curve.count[i]);
  if (!fit) return text;
  const double fitted = column.signal->terms.deviation(tau_s);
  return text + "," + (fitted > 0.0 ? shortest(fitted) : "");
}

}  // namespace

std::string allan_curve_csv(const AllanResult& result) {
  std::vector<Column> columns = columns_of(result);
  std::string text = "tau_s";
  for (const Column& column : columns) text += header_of(column);
  text += '\n';
  for (const double tau_s : all_taus(columns)) {
    text += shortest(tau_s);
    for (Column& column : columns) text += cells_of(column, tau_s);
    text += '\n';
  }
  return text;
}

}  // namespace vispline
