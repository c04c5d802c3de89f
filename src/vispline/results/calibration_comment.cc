#include "vispline/results/calibration_comment.h"

#include <algorithm>

#include "vispline/results/table.h"

namespace vispline {
namespace {

std::string line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return "# " + text + "\n";
}

bool belongs(const std::string& parameter, const std::vector<std::string>& sensors) {
  return sensors.empty() ||
         std::ranges::any_of(sensors, [&](const std::string& s) { return parameter.starts_with(s + "."); });
}

}  // namespace

std::string calibration_comment(const CalibrationResult& result, const std::vector<std::string>& sensors) {
  std::string text = line("class: " + std::string(to_name(result.result_class)));
  for (const std::string& reason : result.reasons) text += line(reason);
  for (const EstimatedParameter& p : result.parameters) {
    if (!belongs(p.name, sensors)) continue;
    for (const ParameterComponent& c : p.components) {
      text += line(p.name + (c.name.empty() ? "" : " " + c.name) + ": sigma " + number_text(c.sigma, 3) + " " + c.unit +
                   (c.observable() ? "" : ", not observable: the number is no measurement"));
    }
  }
  return text;
}

}  // namespace vispline
