#include "vispline/simulate/stamps.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr double kLargestRate_hz = 1e8;
constexpr double kGap = 1.5;  // periods

[[noreturn]] void fail(ExitCode exit_code, std::string code, std::string message, std::string next) {
  throw Error(exit_code, {.code = std::move(code),
                          .message = std::move(message),
                          .where = "",
                          .effect = "nothing simulated",
                          .next = std::move(next)});
}

void check(const std::vector<Time>& stamps) {
  if (stamps.size() < 2) {
    fail(ExitCode::kUnfit, "E-TOO-SHORT", "expected at least 2 stamps, found " + std::to_string(stamps.size()),
         "give the stamps of a longer recording, or a rate");
  }
  const auto bad = std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>());
  if (bad == stamps.end()) return;
  fail(ExitCode::kInput, "E-ORDER",
       "stamp " + std::to_string(to_ns(bad[1])) + " ns follows " + std::to_string(to_ns(bad[0])) + " ns after " +
           std::to_string(bad - stamps.begin() + 1) + " samples",
       "sort the stamps and remove duplicates");
}

double median_step(const std::vector<Time>& stamps) {
  std::vector<Duration> steps(stamps.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = stamps[i + 1] - stamps[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return to_seconds(*middle);
}

}  // namespace

Stamps::Stamps(SampleClock clock, Duration duration) : clock_(clock) {
  require(clock.rate_hz > 0.0 && clock.rate_hz <= kLargestRate_hz, "a sample rate above 0 and up to 1e8 Hz");
  require(duration > Duration::zero(), "a positive duration");
  size_ = static_cast<std::size_t>(clock.count(duration));
  period_ = 1.0 / clock.rate_hz;
}

Stamps::Stamps(std::vector<Time> stamps) : list_(std::move(stamps)), size_(list_.size()) {
  check(list_);
  period_ = median_step(list_);
}

double Stamps::step(std::size_t index) const {
  if (list_.empty() || index + 1 == size_) return period_;
  return to_seconds(list_[index + 1] - list_[index]);
}

double Stamps::averaging_time(std::size_t index) const {
  if (list_.empty() || index == 0) return period_;
  const double before = step(index - 1);
  return before > kGap * period_ ? period_ : before;
}

}  // namespace vispline
