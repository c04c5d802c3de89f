#include "vispline/results/allan_documents.h"
#include "vispline/results/allan_summary.h"
#include "vispline/results/allan_words.h"
#include "vispline/results/table.h"

namespace vispline {
namespace {

constexpr int kDigits = 4;

/// A line that says where the value comes from. Precondition: limit() has a value.
std::string comment_of(const SensorSummary& sensor, Term term) {
  const TermSummary& s = sensor[term];
  std::string text = "# " + unit_of(term, sensor.unit);
  if (s.worst == s.limit()) text += ", worst axis (" + s.worst_axis + ")";
  if (s.mean) text += ", mean " + scientific_text(s.mean, kDigits);
  if (s.unresolved_axes.empty()) return text + "\n";
  text += ", not observable on";
  for (const std::string& axis : s.unresolved_axes) text += " " + axis;
  return text + ": 95 % bound " + scientific_text(s.upper_bound, kDigits) + "\n";
}

std::string line_of(const SensorSummary& sensor, Term term) {
  const std::string key = kalibr_key(sensor.sensor, term);
  const auto value = sensor[term].limit();
  if (!value) return "# " + key + ": not observable in this record, and no bound\n";
  return comment_of(sensor, term) + key + ": " + scientific_text(value, kDigits) + "\n";
}

}  // namespace

std::string allan_kalibr_yaml(const AllanResult& result) {
  const std::vector<SensorSummary> sensors = summarize(result);
  std::string text;
  for (const char* name : {"accelerometer", "gyroscope"}) {
    for (const SensorSummary& sensor : sensors) {
      if (sensor.sensor == name) text += line_of(sensor, Term::kWhite) + line_of(sensor, Term::kRandomWalk);
    }
  }
  if (text.empty()) return "";
  const std::string rate = number_text(result.rate_hz, 9);
  return text + "update_rate: " + rate + (rate.find('.') == std::string::npos ? ".0\n" : "\n");
}

}  // namespace vispline
