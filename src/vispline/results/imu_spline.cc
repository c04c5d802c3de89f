#include "vispline/results/imu_spline.h"

#include <algorithm>

namespace vispline {
namespace {

constexpr double kHalfNanosecond = 5e-10;  // s, the rounding of a limit that is a whole number of steps

}  // namespace

ImuSpline::ImuSpline(const ImuSignal& imu, double max_gap_s) : curvature_(imu.size(), Vector6d::Zero()) {
  std::size_t begin = 0, stretch = 0;
  for (std::size_t i = 0; i < imu.size(); ++i) {
    seconds_.push_back(to_seconds(imu.time[i] - imu.time[0]));
    value_.emplace_back();
    value_.back() << imu.value[i].gyro, imu.value[i].accel;
    if (i > 0 && seconds_[i] - seconds_[i - 1] > max_gap_s + kHalfNanosecond) {
      solve_stretch(begin, i);
      begin = i;
      ++stretch;
    }
    stretch_.push_back(stretch);
  }
  solve_stretch(begin, imu.size());
}

/// Thomas' algorithm for the second derivatives M_i of samples [begin, end):
///   h_{i-1} M_{i-1} + 2 (h_{i-1} + h_i) M_i + h_i M_{i+1} = 6 (slope_i - slope_{i-1}),  M equal at either end.
void ImuSpline::solve_stretch(std::size_t begin, std::size_t end) {
  if (end - begin < 3) return;
  const auto step = [&](std::size_t i) { return seconds_[i + 1] - seconds_[i]; };
  const auto slope = [&](std::size_t i) -> Vector6d { return (value_[i + 1] - value_[i]) / step(i); };
  std::vector<double> upper(end - begin, 0.0);
  for (std::size_t i = begin + 1; i + 1 < end; ++i) {
    const bool first = i == begin + 1, last = i + 2 == end;
    const double lower = first ? 0.0 : step(i - 1);
    const double diagonal = 2.0 * (step(i - 1) + step(i)) + (first ? step(i - 1) : 0.0) + (last ? step(i) : 0.0);
    const double pivot = diagonal - lower * upper[i - 1 - begin];
    upper[i - begin] = last ? 0.0 : step(i) / pivot;
    curvature_[i] = (6.0 * (slope(i) - slope(i - 1)) - lower * curvature_[i - 1]) / pivot;
  }
  for (std::size_t i = end - 2; i-- > begin + 1;) curvature_[i] -= upper[i - begin] * curvature_[i + 1];
  curvature_[begin] = curvature_[begin + 1];
  curvature_[end - 1] = curvature_[end - 2];
}

std::optional<std::size_t> ImuSpline::interval(double seconds) const {
  const auto after = std::upper_bound(seconds_.begin(), seconds_.end(), seconds);
  if (after == seconds_.begin()) return std::nullopt;
  auto i = static_cast<std::size_t>(after - seconds_.begin()) - 1;
  const bool at_stretch_end = i + 1 == seconds_.size() || stretch_[i] != stretch_[i + 1];
  if (at_stretch_end && seconds > seconds_[i]) return std::nullopt;
  if (at_stretch_end && (i == 0 || stretch_[i - 1] != stretch_[i])) return std::nullopt;  // a sample on its own
  return at_stretch_end ? i - 1 : i;
}

bool ImuSpline::covers(double begin_s, double end_s) const {
  const std::optional<std::size_t> begin = interval(begin_s), end = interval(end_s);
  return begin && end && stretch_[*begin] == stretch_[*end];
}

Vector6d ImuSpline::value(std::size_t i, double seconds) const {
  const double h = seconds_[i + 1] - seconds_[i];
  const double b = (seconds - seconds_[i]) / h, a = 1.0 - b;
  return a * value_[i] + b * value_[i + 1] +
         (h * h / 6.0) * ((a * a * a - a) * curvature_[i] + (b * b * b - b) * curvature_[i + 1]);
}

Vector6d ImuSpline::rate(std::size_t i, double seconds) const {
  const double h = seconds_[i + 1] - seconds_[i];
  const double b = (seconds - seconds_[i]) / h, a = 1.0 - b;
  return (value_[i + 1] - value_[i]) / h +
         (h / 6.0) * ((3.0 * b * b - 1.0) * curvature_[i + 1] - (3.0 * a * a - 1.0) * curvature_[i]);
}

}  // namespace vispline
