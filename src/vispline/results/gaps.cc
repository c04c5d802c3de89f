#include "vispline/results/gaps.h"

#include <algorithm>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

std::string span_text(std::string_view name, TimeSpan span) {
  return std::string(name) + " covers [" + seconds_text(span.begin) + ", " + seconds_text(span.end) + "] s";
}

}  // namespace

double median_period_s(const std::vector<Time>& time) {
  if (time.size() < 2) return 0.0;
  std::vector<Duration> steps(time.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = time[i + 1] - time[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return to_seconds(*middle);
}

double gap_limit_s(const std::vector<Time>& time, double periods, double floor_s) {
  return std::max(periods * median_period_s(time), floor_s);
}

std::string seconds_text(Time time) {
  const std::int64_t ns = to_ns(time);
  const std::uint64_t magnitude = ns < 0 ? 0 - static_cast<std::uint64_t>(ns) : static_cast<std::uint64_t>(ns);
  const std::string fraction = std::to_string(magnitude % 1000000000u);
  std::string text = ns < 0 ? "-" : "";
  text += std::to_string(magnitude / 1000000000u) + ".";
  return text.append(9 - fraction.size(), '0') + fraction;
}

void throw_no_overlap(std::string_view first, TimeSpan first_span, std::string_view second, TimeSpan second_span,
                      std::string next) {
  throw Error(ExitCode::kUnfit, {.code = "E-OVERLAP",
                                 .message = "the two records share no usable time: " + span_text(first, first_span) +
                                            ", " + span_text(second, second_span),
                                 .where = "",
                                 .effect = "nothing compared",
                                 .next = std::move(next)});
}

}  // namespace vispline
