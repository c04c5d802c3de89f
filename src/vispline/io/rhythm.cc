#include "vispline/io/rhythm.h"

#include <algorithm>

#include "vispline/io/stamp_rate.h"

namespace vispline {
namespace {

constexpr std::int64_t kMinGap = 100'000'000;  // 0.1 s
constexpr std::size_t kMostLongSteps = 8192;
constexpr std::size_t kMostShown = 5;

bool is_longer(const Gap& a, const Gap& b) {
  return a.length_ns != b.length_ns ? a.length_ns > b.length_ns : a.after_ns < b.after_ns;
}

}  // namespace

std::optional<double> Rhythm::rate_hz() const {
  if (count < 2 || end_ns <= begin_ns) return std::nullopt;
  return static_cast<double>(count - 1) / duration_s();
}

void RhythmMeter::add(std::int64_t ns) {
  Rhythm& r = so_far_;
  if (r.count++ == 0) {
    r.begin_ns = r.end_ns = last_ns_ = ns;
    return;
  }
  r.out_of_order += ns < r.end_ns;
  r.duplicates += ns == last_ns_;
  std::int64_t step = 0;
  const bool fits = !__builtin_sub_overflow(ns, last_ns_, &step);
  if (fits && step > 0) {
    steps_.add(step);
    if (step > kMinGap) long_steps_.push_back({last_ns_, step});
  }
  if (long_steps_.size() >= 2 * kMostLongSteps) {
    std::ranges::nth_element(long_steps_, long_steps_.begin() + kMostLongSteps, is_longer);
    long_steps_.resize(kMostLongSteps);
  }
  r.begin_ns = std::min(r.begin_ns, ns);
  r.end_ns = std::max(r.end_ns, ns);
  last_ns_ = ns;
}

/// The longest first. Beyond some thousand long steps the shorter ones are forgotten.
std::vector<Gap> RhythmMeter::gaps(std::int64_t limit_ns) const {
  std::vector<Gap> found;
  std::ranges::copy_if(long_steps_, std::back_inserter(found),
                       [&](const Gap& gap) { return gap.length_ns > limit_ns; });
  std::ranges::sort(found, is_longer);
  return found;
}

Rhythm RhythmMeter::rhythm() const {
  Rhythm r = so_far_;
  if (steps_.empty()) return r;
  r.median_step_ns = median_of_steps(steps_.values());
  const auto range = static_cast<double>(quantile(steps_.values(), 0.95) - quantile(steps_.values(), 0.05));
  r.jitter = 0.5 * range / static_cast<double>(r.median_step_ns);
  std::vector<Gap> all = gaps(std::max(10 * r.median_step_ns, kMinGap));
  r.gaps = static_cast<std::int64_t>(all.size());
  for (const Gap& gap : all) r.gaps_ns += gap.length_ns;
  all.resize(std::min(all.size(), kMostShown));
  r.longest_gaps = std::move(all);
  return r;
}

}  // namespace vispline
