#include "vispline/io/stamp_rate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>

namespace vispline {
namespace {

constexpr std::int64_t kMinGap = 100'000'000;  // 0.1 s
constexpr std::size_t kMinRows = 10;           ///< below this a rate says nothing
constexpr double kMaxJitter = 0.2, kMaxLost = 0.001, kMaxRateChange = 0.02;
/// Rounding is worth a warning if a step holds fewer than this many units of it.
constexpr std::int64_t kCoarse = 20;

std::string seconds(std::int64_t ns) { return brief_seconds(static_cast<double>(ns) * 1e-9); }
std::string milliseconds(std::int64_t ns) { return brief(static_cast<double>(ns) * 1e-6) + " ms"; }

std::int64_t gap_limit(std::int64_t step) { return std::max(10 * step, kMinGap); }

void check_gaps(ReadContext& context, const StampedRows& rows, std::int64_t step) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::int64_t gap = rows.ns[i] - rows.ns[i - 1];
    if (gap <= gap_limit(step)) continue;
    context.warn("W-GAP", "gap of " + seconds(gap) + " after t = " + seconds(rows.ns[i - 1]),
                 context.where_row(rows.row[i]), "nothing is put in its place");
  }
}

/// The steps, sorted; a fixed sample of them if there are many.
std::vector<std::int64_t> sorted_steps(const StampedRows& rows) {
  std::vector<std::int64_t> steps;
  const std::size_t stride = sampling_stride(rows.size());
  for (std::size_t i = 1; i < rows.size(); i += stride) steps.push_back(rows.ns[i] - rows.ns[i - 1]);
  std::sort(steps.begin(), steps.end());
  return steps;
}

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
double rate_change(const StampedRows& rows) {
  const auto middle = rows.ns.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2);
  const auto a = static_cast<double>(median_step_ns({rows.ns.begin(), middle}));
  const auto b = static_cast<double>(median_step_ns({middle, rows.ns.end()}));
  return std::abs(a - b) / std::max(a, b);
}

void check_rhythm(ReadContext& context, const StampedRows& rows, const std::vector<std::int64_t>& steps,
                  std::int64_t step) {
  const auto at = [&](double part) {
    return static_cast<double>(steps[static_cast<std::size_t>(part * static_cast<double>(steps.size() - 1))]);
  };
  const double jitter = 0.5 * (at(0.95) - at(0.05)) / static_cast<double>(step);
  const auto lost = std::count_if(steps.begin(), steps.end(), [&](std::int64_t s) { return s > step + step / 2; });
  const double lost_share = static_cast<double>(lost) / static_cast<double>(steps.size());
  const double change = rate_change(rows);
  std::string found;
  if (jitter > kMaxJitter) found += "jitter " + percent(jitter) + "; ";
  if (lost_share > kMaxLost) found += percent(lost_share) + " of the steps miss samples; ";
  if (change > kMaxRateChange) found += "the rate changes by " + percent(change) + "; ";
  if (found.empty()) return;
  context.warn("W-RATE", found + "steps in parts of " + milliseconds(step) + ": " + histogram(steps, step),
               context.path(), "all rows are kept, at their stamps");
}

}  // namespace

void check_rate(ReadContext& context, const StampedRows& rows) {
  if (rows.size() < kMinRows) return;
  const std::int64_t step = median_step_ns(rows.ns);
  const std::vector<std::int64_t> steps = sorted_steps(rows);
  check_gaps(context, rows, step);
  check_precision(context, steps, step);
  check_rhythm(context, rows, steps, step);
}

}  // namespace vispline
