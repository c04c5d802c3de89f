#include "vispline/io/stamp_rate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>

#include "vispline/io/number_text.h"

namespace vispline {
namespace {

constexpr std::int64_t kMinGap = 100'000'000;  // 0.1 s
constexpr std::int64_t kMinRows = 10;          ///< below this a rate says nothing
constexpr std::int64_t kMaxStep = INT64_MAX / 2048;
/// Long steps that wait for the median at most. Only a signal below 10 Hz has as many.
constexpr std::size_t kMostLongSteps = 4096;
constexpr double kMaxJitter = 0.2, kMaxLost = 0.001, kMaxRateChange = 0.02;
/// Rounding is worth a warning if a step holds fewer than this many units of it.
constexpr std::int64_t kCoarse = 20;

std::string seconds(std::int64_t ns) { return brief_seconds(static_cast<double>(ns) * 1e-9); }
std::string milliseconds(std::int64_t ns) { return brief(static_cast<double>(ns) * 1e-6) + " ms"; }

void check_precision(ReadContext& context, const std::vector<std::int64_t>& steps, std::int64_t step) {
  std::int64_t unit = 0;
  for (const std::int64_t s : steps) unit = std::gcd(unit, s);
  const bool varied = steps.front() != steps.back();
  if (!varied || unit == 0 || step / unit < 2 || step / unit > kCoarse) return;
  context.warn(
      "W-TIME-PRECISION",
      "all stamps are multiples of " + milliseconds(unit) + ", a coarse part of the step of " + milliseconds(step),
      context.path(), "the stamps are kept as written");
}

/// "dt 0-0.5: 0.1 %, 0.5-0.9: ..." in parts of the median step.
std::string histogram(const std::vector<std::int64_t>& steps, std::int64_t step) {
  constexpr std::array<double, 9> kEdges = {0.0, 0.5, 0.8, 0.95, 1.05, 1.2, 1.5, 2.5, INFINITY};
  std::string text;
  for (std::size_t i = 0; i + 1 < kEdges.size(); ++i) {
    const auto count = std::count_if(steps.begin(), steps.end(), [&](std::int64_t s) {
      const double part = static_cast<double>(s) / static_cast<double>(step);
      return part >= kEdges[i] && part < kEdges[i + 1];
    });
    if (count == 0) continue;
    if (!text.empty()) text += ", ";
    text += brief(kEdges[i]) + "-" + brief(kEdges[i + 1]) + ": " +
            percent(static_cast<double>(count) / static_cast<double>(steps.size()));
  }
  return text;
}

/// Relative difference of the median steps of the two halves.
double rate_change(const std::vector<std::int64_t>& steps) {
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  const auto a = static_cast<double>(median_of_steps({steps.begin(), middle}));
  const auto b = static_cast<double>(median_of_steps({middle, steps.end()}));
  return std::abs(a - b) / std::max(a, b);
}

void check_rhythm(ReadContext& context, const std::vector<std::int64_t>& steps, std::int64_t step, double change) {
  const auto at = [&](double part) {
    return static_cast<double>(steps[static_cast<std::size_t>(part * static_cast<double>(steps.size() - 1))]);
  };
  const double jitter = 0.5 * (at(0.95) - at(0.05)) / static_cast<double>(step);
  const auto lost = std::count_if(steps.begin(), steps.end(), [&](std::int64_t s) { return s > step + step / 2; });
  const double lost_share = static_cast<double>(lost) / static_cast<double>(steps.size());
  std::string found;
  if (jitter > kMaxJitter) found += "jitter " + percent(jitter) + "; ";
  if (lost_share > kMaxLost) found += percent(lost_share) + " of the steps miss samples; ";
  if (change > kMaxRateChange) found += "the rate changes by " + percent(change) + "; ";
  if (found.empty()) return;
  context.warn("W-RATE", found + "steps in parts of " + milliseconds(step) + ": " + histogram(steps, step),
               context.path(), "all rows are kept, at their stamps");
}

}  // namespace

std::int64_t median_of_steps(std::vector<std::int64_t> steps) {
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return std::min(*middle, kMaxStep);
}

void RateCheck::add_step(std::int64_t ns, std::int64_t where) {
  const std::int64_t step = ns - last_;
  steps_.add(step);
  if (step <= kMinGap) return;
  long_steps_.push_back({last_, step, where});
  if (long_steps_.size() == kMostLongSteps) judge_gaps();
}

std::int64_t RateCheck::median_step() const { return median_of_steps(steps_.values()); }

void RateCheck::judge_gaps() {
  const std::int64_t limit = std::max(10 * median_step(), kMinGap);
  for (const Gap& gap : long_steps_) {
    if (gap.step <= limit) continue;
    ++gaps_;
    in_gaps_ += gap.step;
    if (gap.step > longest_.step) longest_ = gap;
  }
  long_steps_.clear();
}

void RateCheck::tell_gaps() {
  if (gaps_ == 0) return;
  const std::string size = seconds(longest_.step), after = "after t = " + seconds(longest_.after);
  context_.warn("W-GAP",
                gaps_ == 1 ? "gap of " + size + " " + after
                           : std::to_string(gaps_) + " gaps, " + seconds(in_gaps_) + " in all; the longest, " + size +
                                 ", " + after,
                context_.where_line(longest_.where),
                gaps_ == 1 ? "nothing is put in its place" : "nothing is put in their place");
}

void RateCheck::judge() {
  if (rows_ < kMinRows) return;
  judge_gaps();
  tell_gaps();
  const std::int64_t step = median_step();
  std::vector<std::int64_t> steps = steps_.values();
  const double change = rate_change(steps);
  std::sort(steps.begin(), steps.end());
  check_precision(context_, steps, step);
  check_rhythm(context_, steps, step, change);
}

}  // namespace vispline
