#include "vispline/io/imu_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "vispline/io/number_text.h"

namespace vispline {
namespace {

constexpr std::size_t kMinRows = 10;  ///< below this the checks say nothing
constexpr double kMaxGyro = 35.0;     // rad/s, 2000 deg/s: the range of nearly every MEMS gyroscope
constexpr double kUnusualShare = 0.001;
constexpr std::array kAxes = {"gyro x", "gyro y", "gyro z", "accel x", "accel y", "accel z"};
/// A spike stands off by this much at least, rad/s and m/s^2: a knock on the IMU is weaker or lasts longer.
constexpr std::array kMinSpike = {10.0, 10.0, 10.0, 50.0, 50.0, 50.0};

double axis_value(const ImuSample& sample, int axis) { return axis < 3 ? sample.gyro[axis] : sample.accel[axis - 3]; }

std::vector<double> axis_values(const ImuSignal& imu, int axis) {
  std::vector<double> values(imu.size());
  for (std::size_t i = 0; i < imu.size(); ++i) values[i] = axis_value(imu.value[i], axis);
  return values;
}

double quantile(std::vector<double> values, double part) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Median norms on an evenly spaced part of the samples.
struct Norms {
  double gyro = 0.0;
  double accel = 0.0;
  double high_gyro_share = 0.0;  ///< samples above kMaxGyro
};

Norms norms_of(const ImuSignal& imu) {
  std::vector<double> gyro, accel;
  const std::size_t stride = sampling_stride(imu.size());
  for (std::size_t i = 0; i < imu.size(); i += stride) {
    gyro.push_back(imu.value[i].gyro.norm());
    accel.push_back(imu.value[i].accel.norm());
  }
  const auto high = std::count_if(gyro.begin(), gyro.end(), [](double norm) { return norm > kMaxGyro; });
  const double share = static_cast<double>(high) / static_cast<double>(gyro.size());
  return {quantile(std::move(gyro), 0.5), quantile(std::move(accel), 0.5), share};
}

std::string suspicion(const Norms& n) {
  const std::string accel = "median |a| is " + brief(n.accel);
  if (n.gyro > 8.0 && n.gyro < 12.0 && n.accel < 5.0)
    return "gyroscope and accelerometer look swapped: median |gyro| is " + brief(n.gyro) + ", " + accel;
  if (n.accel >= 0.8 && n.accel <= 1.2) return accel + ": looks like g instead of m/s^2";
  if (n.accel >= 800.0 && n.accel <= 1200.0) return accel + ": looks like mg instead of m/s^2";
  if (n.accel < 5.0) return accel + " m/s^2: gravity seems to be taken off";
  if (n.high_gyro_share > kUnusualShare) {
    return percent(n.high_gyro_share) + " of |gyro| is above 35 rad/s: looks like deg/s instead of rad/s";
  }
  return "";
}

void check_units(ReadContext& context, const ImuSignal& imu) {
  const std::string found = suspicion(norms_of(imu));
  if (found.empty()) return;
  context.warn("W-UNITS", found, context.path(), "the numbers are kept as they are",
               "pass --columns with units, such as \"t,gx [deg/s],gy [deg/s],gz [deg/s],ax [g],ay [g],az [g]\"");
}

void check_constant(ReadContext& context, const ImuSignal& imu) {
  std::array<bool, 6> constant{};
  for (int axis = 0; axis < 6; ++axis) {
    const double first = axis_value(imu.value[0], axis);
    constant[static_cast<std::size_t>(axis)] = std::all_of(
        imu.value.begin(), imu.value.end(), [&](const ImuSample& s) { return axis_value(s, axis) == first; });
  }
  if (std::find(constant.begin(), constant.end(), false) == constant.end() && !context.options().repair) {
    context.fail(ExitCode::kUnfit, "E-CONSTANT",
                 "all six axes are constant over " + std::to_string(imu.size()) + " samples", context.path(),
                 "check that the IMU was on; pass --repair if it is an exact simulation at rest");
  }
  for (std::size_t axis = 0; axis < constant.size(); ++axis) {
    if (!constant[axis]) continue;
    context.warn(
        "W-CONSTANT",
        std::string(kAxes[axis]) + " never changes (" + brief(axis_value(imu.value[0], static_cast<int>(axis))) + ")",
        context.path(), "no noise value can be given for this axis");
  }
}

/// Samples at `extreme` in runs of three or more.
std::int64_t stuck_at(const std::vector<double>& values, double extreme) {
  std::int64_t stuck = 0, run = 0;
  for (const double value : values) {
    run = value == extreme ? run + 1 : 0;
    stuck += run == 3 ? 3 : (run > 3 ? 1 : 0);
  }
  return stuck;
}

/// Smallest change between neighbours that is not zero: at least one least significant bit.
double smallest_change(const std::vector<double>& values) {
  double smallest = INFINITY;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double change = std::abs(values[i] - values[i - 1]);
    if (change > 0.0) smallest = std::min(smallest, change);
  }
  return smallest;
}

void check_saturation(ReadContext& context, const ImuSignal& imu) {
  for (int axis = 0; axis < 6; ++axis) {
    const std::vector<double> values = axis_values(imu, axis);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const std::int64_t stuck = *low == *high ? 0 : stuck_at(values, *low) + stuck_at(values, *high);
    if (static_cast<double>(stuck) <= kUnusualShare * static_cast<double>(values.size())) continue;
    if (*high - *low < 50.0 * smallest_change(values)) continue;  // few levels: quantised noise, not a rail
    context.warn("W-SATURATED",
                 std::string(kAxes[static_cast<std::size_t>(axis)]) + " stays at its extreme (" + brief(*low) + " or " +
                     brief(*high) + ") in " + percent(static_cast<double>(stuck) / static_cast<double>(values.size())) +
                     " of the samples",
                 context.path(), "all samples are kept");
  }
}

/// How far each sample is from the mean of its neighbours.
std::vector<double> bends_of(const std::vector<double>& values) {
  std::vector<double> bends(values.size(), 0.0);
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    bends[i] = std::abs(values[i] - 0.5 * (values[i - 1] + values[i + 1]));
  return bends;
}

void mark_spikes(const std::vector<double>& values, double least, std::vector<std::uint8_t>& keep) {
  const std::vector<double> bends = bends_of(values);
  std::vector<double> some;
  for (std::size_t i = 0; i < bends.size(); i += sampling_stride(bends.size())) some.push_back(bends[i]);
  const double usual = quantile(std::move(some), 0.99);
  const double limit = std::max(least, 20.0 * usual);
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const bool neighbours_agree = std::abs(values[i + 1] - values[i - 1]) < 0.05 * bends[i];
    if (bends[i] > limit && neighbours_agree) keep[i] = 0;
  }
}

}  // namespace

std::vector<std::uint8_t> find_spikes(ReadContext& context, const ImuSignal& imu, const StampedRows& rows) {
  std::vector<std::uint8_t> keep(imu.size(), 1);
  if (imu.size() < kMinRows) return keep;
  for (int axis = 0; axis < 6; ++axis)
    mark_spikes(axis_values(imu, axis), kMinSpike[static_cast<std::size_t>(axis)], keep);
  const std::int64_t spikes = std::count(keep.begin(), keep.end(), 0);
  if (static_cast<double>(spikes) > std::max(1.0, kUnusualShare * static_cast<double>(imu.size())))
    return std::vector<std::uint8_t>(imu.size(), 1);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i])
      context.drop("W-SPIKE", "one sample stands far off while its neighbours agree", context.where_row(rows.row[i]));
  }
  return keep;
}

void check_imu(ReadContext& context, const ImuSignal& imu) {
  if (imu.size() < kMinRows) return;
  check_constant(context, imu);
  check_units(context, imu);
  check_saturation(context, imu);
}

}  // namespace vispline
