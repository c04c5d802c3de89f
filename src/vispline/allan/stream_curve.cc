#include "vispline/allan/stream_curve.h"

#include <algorithm>
#include <cmath>

#include "vispline/allan/factors.h"
#include "vispline/allan/overlapping.h"

namespace vispline {
namespace {

constexpr std::int64_t kFirstStrided = 32;  ///< factors of the upper levels, in points of the level
constexpr std::size_t kHistory = 2 * (2 * kFirstStrided - 1);
constexpr std::size_t kBatch = 4096;  ///< points summed at once, of any level: the same for blocks of any size

}  // namespace

StreamCurve::Level& StreamCurve::level_at(std::size_t index) {
  while (index >= levels_.size()) {
    Level level;
    for (const std::int64_t m : log_factors(2 * kFirstStrided - 1)) {
      if (levels_.empty() || m >= kFirstStrided) level.factors.push_back(m);
    }
    level.sums.resize(level.factors.size());
    levels_.push_back(std::move(level));
  }
  return levels_[index];
}

/// Every difference that ends at a fresh point is counted once.
void StreamCurve::use(Level& level) {
  for (std::size_t i = 0; i < level.factors.size(); ++i) {
    const auto m = static_cast<std::size_t>(level.factors[i]);
    const std::size_t first_end = std::max(level.fresh, 2 * m);
    if (first_end >= level.phase.size()) continue;
    const std::size_t ends = level.phase.size() - first_end;
    level.sums[i].sum += second_difference_sum(level.phase.data() + first_end - 2 * m, m, ends);
    level.sums[i].count += static_cast<std::int64_t>(ends);
  }
  if (level.phase.size() > kHistory) {
    level.phase.erase(level.phase.begin(), level.phase.end() - static_cast<std::ptrdiff_t>(kHistory));
  }
  level.fresh = level.phase.size();
}

void StreamCurve::push_phase(std::size_t index, std::span<const double> points) {
  std::vector<double> halved;
  {
    Level& level = level_at(index);
    for (const double point : points) {
      level.phase.push_back(point);
      if (level.seen++ % 2 == 0) level.pending.push_back(point);
      if (level.phase.size() - level.fresh == kBatch) use(level);
    }
    if (level.seen > 2) halved.swap(level.pending);
  }
  if (!halved.empty()) push_phase(index + 1, halved);
}

void StreamCurve::push(std::span<const double> readings) {
  std::vector<double> points;
  for (std::size_t begin = 0; begin < readings.size(); begin += kBatch) {
    points.clear();
    if (!started_) points.push_back(phase_ = 0.0);
    started_ = true;
    const std::size_t end = std::min(begin + kBatch, readings.size());
    for (std::size_t i = begin; i < end; ++i) points.push_back(phase_ += readings[i] - reference_);
    push_phase(0, points);
  }
}

void StreamCurve::end_segment() {
  for (Level& level : levels_) {
    use(level);
    level.phase.clear();
    level.pending.clear();
    level.seen = 0;
    level.fresh = 0;
  }
  started_ = false;
}

std::vector<StreamCurve::Point> StreamCurve::points() const {
  std::vector<Point> points;
  for (std::size_t s = 0; s < levels_.size(); ++s) {
    for (std::size_t i = 0; i < levels_[s].factors.size(); ++i) {
      if (levels_[s].sums[i].count == 0) continue;
      points.push_back({levels_[s].factors[i] << s, levels_[s].sums[i]});
    }
  }
  return points;
}

}  // namespace vispline
