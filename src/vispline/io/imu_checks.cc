#include "vispline/io/imu_checks.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "vispline/io/number_text.h"

namespace vispline {
namespace {

constexpr std::size_t kMinRows = 10;  ///< below this the checks say nothing
constexpr double kMaxGyro = 35.0;     // rad/s, 2000 deg/s: the range of nearly every MEMS gyroscope
constexpr double kUnusualShare = 0.001;
constexpr std::array kAxes = {"gyro x", "gyro y", "gyro z", "accel x", "accel y", "accel z"};
/// A spike stands off by this much at least, rad/s and m/s^2: a knock on the IMU is weaker or lasts longer.
constexpr std::array kMinSpike = {10.0, 10.0, 10.0, 50.0, 50.0, 50.0};

/// Median norms, of the triads that are whole.
struct Norms {
  std::optional<double> gyro = {};
  std::optional<double> accel = {};
  double high_gyro_share = 0.0;  ///< samples above kMaxGyro
};

Norms norms_of(const EvenSample<double>& gyro, const EvenSample<double>& accel) {
  Norms norms;
  if (!accel.empty()) norms.accel = quantile(accel.values(), 0.5);
  if (gyro.empty()) return norms;
  norms.gyro = quantile(gyro.values(), 0.5);
  const auto high =
      std::count_if(gyro.values().begin(), gyro.values().end(), [](double norm) { return norm > kMaxGyro; });
  norms.high_gyro_share = static_cast<double>(high) / static_cast<double>(gyro.values().size());
  return norms;
}

std::string accel_suspicion(double a, const std::optional<double>& gyro) {
  const std::string found = "median |a| is " + brief(a);
  if (gyro && *gyro > 8.0 && *gyro < 12.0 && a < 5.0)
    return "gyroscope and accelerometer look swapped: median |gyro| is " + brief(*gyro) + ", " + found;
  if (a >= 0.8 && a <= 1.2) return found + ": looks like g instead of m/s^2";
  if (a >= 800.0 && a <= 1200.0) return found + ": looks like mg instead of m/s^2";
  if (a < 5.0) return found + " m/s^2: gravity seems to be taken off";
  return "";
}

std::string suspicion(const Norms& n) {
  const std::string accel = n.accel ? accel_suspicion(*n.accel, n.gyro) : "";
  if (!accel.empty() || n.high_gyro_share <= kUnusualShare) return accel;
  return percent(n.high_gyro_share) + " of |gyro| is above 35 rad/s: looks like deg/s instead of rad/s";
}

/// How far a sample is from the mean of its neighbours.
double bend_at(std::span<const ImuSample> samples, std::size_t i, std::size_t axis) {
  return std::abs(axis_value(samples[i], axis) -
                  0.5 * (axis_value(samples[i - 1], axis) + axis_value(samples[i + 1], axis)));
}

/// The bend that 99 % of the samples stay below.
double usual_bend(std::span<const ImuSample> samples, std::size_t axis) {
  std::vector<double> bends(samples.size(), 0.0);
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) bends[i] = bend_at(samples, i, axis);
  return quantile(std::move(bends), 0.99);
}

void mark_spikes(std::span<const ImuSample> samples, std::size_t axis, std::vector<std::size_t>& spikes) {
  double limit = 0.0;  // found when the first candidate asks for it
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double before = axis_value(samples[i - 1], axis), after = axis_value(samples[i + 1], axis);
    const double bend = std::abs(axis_value(samples[i], axis) - 0.5 * (before + after));
    if (bend <= kMinSpike[axis] || std::abs(after - before) >= 0.05 * bend) continue;
    if (limit == 0.0) limit = std::max(kMinSpike[axis], 20.0 * usual_bend(samples, axis));
    if (bend > limit) spikes.push_back(i);
  }
}

}  // namespace

std::vector<std::size_t> find_spikes(std::span<const ImuSample> samples, const ImuAxes& axes) {
  std::vector<std::size_t> spikes;
  if (samples.size() < kMinRows) return spikes;
  for (std::size_t axis = 0; axis < kImuAxes; ++axis) {
    if (axes.present[axis]) mark_spikes(samples, axis, spikes);
  }
  std::sort(spikes.begin(), spikes.end());
  spikes.erase(std::unique(spikes.begin(), spikes.end()), spikes.end());
  const double allowed = std::max(1.0, kUnusualShare * static_cast<double>(samples.size()));
  if (static_cast<double>(spikes.size()) > allowed) spikes.clear();
  return spikes;
}

void ImuCheck::Extreme::add(double v, bool beyond) {
  if (beyond) *this = {.value = v};
  run = v == value ? run + 1 : 0;
  stuck += run == 3 ? 3 : (run > 3 ? 1 : 0);
}

void ImuCheck::add(std::span<const ImuSample> samples) {
  if (samples.empty()) return;
  values_.resize(samples.size());
  for (std::size_t axis = 0; axis < kImuAxes; ++axis) {
    if (!axes_.present[axis]) continue;
    for (std::size_t i = 0; i < samples.size(); ++i) values_[i] = axis_value(samples[i], axis);
    if (count_ == 0) {
      axis_[axis].first = axis_[axis].last = axis_[axis].low.value = axis_[axis].high.value = values_[0];
    }
    add_axis(axis_[axis], values_);
  }
  for (const ImuSample& sample : samples) {
    if (axes_.whole_gyro()) gyro_norm_.add(sample.gyro.norm());
    if (axes_.whole_accel()) accel_norm_.add(sample.accel.norm());
  }
  count_ += static_cast<std::int64_t>(samples.size());
}

/// Sample by sample only where the values reach an extreme.
void ImuCheck::add_axis(Axis& axis, std::span<const double> values) const {
  double low = values[0], high = values[0], change = axis.smallest_change, last = axis.last;
  for (const double v : values) {
    low = std::min(low, v);
    high = std::max(high, v);
    const double step = std::abs(v - last);
    change = step > 0.0 && step < change ? step : change;
    last = v;
  }
  axis.smallest_change = change;
  axis.last = last;
  if (low > axis.low.value) axis.low.run = 0;
  if (high < axis.high.value) axis.high.run = 0;
  if (low <= axis.low.value) {
    for (const double v : values) axis.low.add(v, v < axis.low.value);
  }
  if (high >= axis.high.value) {
    for (const double v : values) axis.high.add(v, v > axis.high.value);
  }
}

void ImuCheck::judge() {
  if (count_ < static_cast<std::int64_t>(kMinRows)) return;
  judge_constant();
  judge_units();
  judge_saturation();
}

void ImuCheck::judge_constant() {
  std::size_t present = 0, constant = 0;
  for (std::size_t axis = 0; axis < kImuAxes; ++axis) {
    present += axes_.present[axis];
    constant += axes_.present[axis] && axis_[axis].low.value == axis_[axis].high.value;
  }
  if (constant == present && !context_.options().repair) {
    context_.fail(ExitCode::kUnfit, "E-CONSTANT",
                  (present == kImuAxes ? std::string("all six") : "all " + std::to_string(present)) +
                      " axes are constant over " + std::to_string(count_) + " samples",
                  context_.path(), "check that the IMU was on; pass --repair if it is an exact simulation at rest");
  }
  for (std::size_t axis = 0; axis < kImuAxes; ++axis) {
    if (!axes_.present[axis] || axis_[axis].low.value != axis_[axis].high.value) continue;
    context_.warn("W-CONSTANT", std::string(kAxes[axis]) + " never changes (" + brief(axis_[axis].first) + ")",
                  context_.path(), "no noise value can be given for this axis");
  }
}

void ImuCheck::judge_units() {
  const std::string found = suspicion(norms_of(gyro_norm_, accel_norm_));
  if (found.empty()) return;
  context_.warn("W-UNITS", found, context_.path(), "the numbers are kept as they are",
                "pass --gyro-unit deg/s or --accel-unit g, or --columns with units, such as \"t,gx [deg/s],...\"");
}

void ImuCheck::judge_saturation() {
  for (std::size_t i = 0; i < kImuAxes; ++i) {
    const Axis& axis = axis_[i];
    const double low = axis.low.value, high = axis.high.value;
    const std::int64_t stuck = low == high ? 0 : axis.low.stuck + axis.high.stuck;
    if (static_cast<double>(stuck) <= kUnusualShare * static_cast<double>(count_)) continue;
    if (high - low < 50.0 * axis.smallest_change) continue;  // few levels: quantised noise, not a rail
    context_.warn("W-SATURATED",
                  std::string(kAxes[i]) + " stays at its extreme (" + brief(low) + " or " + brief(high) + ") in " +
                      percent(static_cast<double>(stuck) / static_cast<double>(count_)) + " of the samples",
                  context_.path(), "all samples are kept");
  }
}

}  // namespace vispline
