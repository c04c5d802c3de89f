#include "vispline/report/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vispline/core/error.h"
#include "vispline/report/number.h"

namespace vispline::report {
namespace {

constexpr double kLargest = 1e300;
constexpr double kSmallest = 1e-290;
constexpr double kThinnest = 1e-12;  ///< of the largest value: below that a range counts as one value
constexpr Range kNothing{1.0, 0.0};

Range widened_value(double value, bool log) {
  if (log) return {std::max(value / 3.0, kSmallest), value * 3.0};
  const double half = std::abs(value) < kSmallest ? 1.0 : 0.05 * std::abs(value);
  return {value - half, value + half};
}

Range with_margin(Range r, bool log, double margin) {
  if (log) {
    const double factor = std::exp(margin * (std::log(r.hi) - std::log(r.lo)));
    return {std::max(r.lo / factor, kSmallest), std::min(r.hi * factor, 3.0 * kLargest)};
  }
  const double extra = margin * (r.hi - r.lo);
  return {r.lo - extra, r.hi + extra};
}

bool has_points(const Plot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(), [](const Series& s) {
    return s.style == SeriesStyle::kPoints || s.style == SeriesStyle::kLineAndPoints;
  });
}

Range x_extent(const Plot& plot) {
  Range all = kNothing;
  for (const Series& s : plot.series) all = united(all, extent(s.x, plot.log_x));
  return all;
}

Range y_extent(const Plot& plot) {
  Range all = kNothing;
  for (const Series& s : plot.series) {
    for (const auto* values : {&s.y, &s.lower, &s.upper}) all = united(all, extent(*values, plot.log_y));
  }
  return all;
}

Range checked(Range given, bool log) {
  require(drawable(given.lo, log) && drawable(given.hi, log) && given.lo < given.hi,
          "a plot range with lo < hi, both finite, and positive on a logarithmic axis");
  return padded(given, log, 0.0);
}

/// An end that all but reaches a round number goes there: 0 to 19.995 s is marked up to 20.
Range rounded(Range r) {
  const double length = r.hi - r.lo;
  const int exponent = decimal_exponent(length) - 1;
  const auto scaled = [&](double v) { return exponent < 0 ? v * power_of_ten(-exponent) : v / power_of_ten(exponent); };
  const auto value = [&](double n) { return exponent < 0 ? n / power_of_ten(-exponent) : n * power_of_ten(exponent); };
  const double lo = value(std::floor(scaled(r.lo)));
  const double hi = value(std::ceil(scaled(r.hi)));
  constexpr double kNear = 0.02;
  return {r.lo - lo < kNear * length ? lo : r.lo, hi - r.hi < kNear * length ? hi : r.hi};
}

Range x_range(const Plot& plot) {
  if (plot.x_range) return checked(*plot.x_range, plot.log_x);
  if (plot.equal_aspect || plot.log_x || has_points(plot)) return padded(x_extent(plot), plot.log_x, 0.03);
  return rounded(padded(x_extent(plot), false, 0.0));
}

Range y_range(const Plot& plot) {
  if (plot.y_range) return checked(*plot.y_range, plot.log_y);
  return padded(y_extent(plot), plot.log_y, 0.05);
}

/// The same centre, `length` long.
Range stretched(Range r, double length) {
  const double centre = 0.5 * r.lo + 0.5 * r.hi;
  return {centre - 0.5 * length, centre + 0.5 * length};
}

}  // namespace

bool drawable(double value, bool log) {
  return std::isfinite(value) && std::abs(value) <= kLargest && (!log || value >= kSmallest);
}

Range extent(std::span<const double> values, bool log) {
  Range r{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!drawable(value, log)) continue;
    r.lo = std::min(r.lo, value);
    r.hi = std::max(r.hi, value);
  }
  return r;
}

Range united(Range a, Range b) {
  if (a.lo > a.hi) return b;
  if (b.lo > b.hi) return a;
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

Range padded(Range extent, bool log, double margin) {
  if (extent.lo > extent.hi) return log ? Range{1.0, 10.0} : Range{0.0, 1.0};
  const double largest = std::max(std::abs(extent.lo), std::abs(extent.hi));
  if (extent.hi - extent.lo <= std::max(kThinnest * largest, kSmallest)) {
    return widened_value(0.5 * extent.lo + 0.5 * extent.hi, log);
  }
  return with_margin(extent, log, margin);
}

Axis::Axis(Range range, bool log, double length_px, bool upwards)
    : range_(range), log_(log), length_px_(length_px), upwards_(upwards) {}

double Axis::place(double value) const {
  if (!log_) return (value - range_.lo) / (range_.hi - range_.lo);
  return (std::log10(value) - std::log10(range_.lo)) / (std::log10(range_.hi) - std::log10(range_.lo));
}

double Axis::to_px(double value) const {
  const double along = length_px_ * place(value);
  return std::clamp(upwards_ ? length_px_ - along : along, -1e5, 1e5);
}

Axes make_axes(const Plot& plot, double width_px, double height_px) {
  require(!plot.equal_aspect || !(plot.log_x || plot.log_y), "linear axes in a plot of equal aspect");
  Range x = x_range(plot);
  Range y = y_range(plot);
  if (plot.equal_aspect) {
    const double unit_per_px = std::max((x.hi - x.lo) / width_px, (y.hi - y.lo) / height_px);
    x = stretched(x, unit_per_px * width_px);
    y = stretched(y, unit_per_px * height_px);
  }
  return {Axis(x, plot.log_x, width_px, false), Axis(y, plot.log_y, height_px, true)};
}

}  // namespace vispline::report
