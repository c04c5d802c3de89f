#include "vispline/results/allan_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "vispline/results/table.h"

namespace vispline {
namespace {

std::string to_text(double value, std::chars_format format, int precision) {
  std::array<char, 400> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, precision).ptr};
}

std::string comma_separated(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// 2.5, 14, 310.
std::string about(double value) {
  return value < 9.95 ? number_text(value, 2) : to_text(value, std::chars_format::fixed, 0);
}

}  // namespace

std::string scientific_text(const std::optional<double>& value, int digits) {
  if (!value || !std::isfinite(*value)) return "-";
  return to_text(*value, std::chars_format::scientific, std::max(digits - 1, 1));
}

std::string percent_text(double percent) {
  if (!std::isfinite(percent)) return "-";
  if (std::abs(percent) >= 9.95) return to_text(percent, std::chars_format::fixed, 0);
  return to_text(percent, std::chars_format::fixed, std::abs(percent) >= 0.995 ? 1 : 2);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  if (seconds < 120.0) return about(seconds) + " s";
  if (seconds < 7200.0) return about(seconds / 60.0) + " min";
  if (seconds < 172800.0) return about(seconds / 3600.0) + " h";
  return about(seconds / 86400.0) + " days";
}

std::string kalibr_key(std::string_view sensor, Term term) {
  if (sensor != "gyroscope" && sensor != "accelerometer") return "";
  if (term == Term::kWhite) return std::string(sensor) + "_noise_density";
  if (term == Term::kRandomWalk) return std::string(sensor) + "_random_walk";
  return "";
}

std::string quantity_name(std::string_view sensor, Term term) {
  const std::string key = kalibr_key(sensor, term);
  return key.empty() ? std::string(sensor) + " " + std::string(symbol_of(term)) : key;
}

std::string unresolved_text(const SensorSummary& sensor, Term term) {
  const TermSummary& summary = sensor[term];
  std::string text = std::string(symbol_of(term)) + " of " + sensor.sensor;
  const std::string axes = comma_separated(summary.unresolved_axes);
  if (!axes.empty()) text += " " + axes;
  text += ": not observable in this record";
  const std::string unit = unit_of(term, sensor.unit);
  if (summary.upper_bound) text += ", < " + scientific_text(summary.upper_bound, 2) + (unit.empty() ? "" : " " + unit);
  if (summary.record_needed_s) {
    text += "; a record of about " + duration_text(*summary.record_needed_s) + " would resolve it";
  }
  return text;
}

std::vector<Term> unresolved_terms(const AllanResult& result, const SensorSummary& sensor) {
  std::vector<Term> terms;
  for (const Term term : {Term::kWhite, Term::kRandomWalk, Term::kFlicker, Term::kQuantization, Term::kRamp}) {
    if (sensor[term].unresolved_axes.empty()) continue;
    const bool always = term != Term::kQuantization && term != Term::kRamp;
    const auto useful = [&](std::size_t i) { return useful_bound(result.signals[i], term); };
    if (always || std::any_of(sensor.signals.begin(), sensor.signals.end(), useful)) terms.push_back(term);
  }
  return terms;
}

std::string curve_unit(Deviation kind, std::string_view unit) {
  return kind == Deviation::kTdev ? unit_of(Term::kQuantization, unit) : std::string(unit);
}

}  // namespace vispline
