#include "vispline/report/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "vispline/report/number.h"

namespace vispline::report {
namespace {

constexpr int kMinTicks = 4;
constexpr int kMaxTicks = 9;
constexpr int kMinDecades = 3;       ///< fewer are marked inside as well
constexpr int kMaxMinorDecades = 7;  ///< more leave no room for minor ticks

/// A step of digits * 10^exponent: 1, 2, 5 or 25.
struct Step {
  int digits;
  int exponent;
  double size() const { return multiple(1); }
  double multiple(std::int64_t k) const {
    const auto units = static_cast<double>(k * digits);
    return exponent < 0 ? units / power_of_ten(-exponent) : units * power_of_ten(exponent);
  }
};

std::vector<double> multiples_inside(Range range, Step step) {
  std::vector<double> values;
  auto k = static_cast<std::int64_t>(std::floor(range.lo / step.size())) - 1;
  for (; step.multiple(k) <= range.hi; ++k) {
    if (step.multiple(k) >= range.lo) values.push_back(step.multiple(k));
  }
  return values;
}

bool good_count(const std::vector<double>& values) { return values.size() >= kMinTicks && values.size() <= kMaxTicks; }

Step best_step(Range range, int target) {
  const int exponent = decimal_exponent(range.hi - range.lo);
  Step best{25, exponent - 2};
  int best_distance = 100;
  for (const Step step : {Step{5, exponent - 1}, Step{2, exponent - 1}, Step{1, exponent}, Step{2, exponent}}) {
    const auto values = multiples_inside(range, step);
    const int distance = std::abs(static_cast<int>(values.size()) - target);
    if (!good_count(values) || distance >= best_distance) continue;
    best = step;
    best_distance = distance;
  }
  return best;
}

std::string with_minus_sign(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

TickLabel scientific_label(double value, int exponent, int decimals) {
  if (value == 0.0) return {"0", std::nullopt};
  const double mantissa = exponent < 0 ? value * power_of_ten(-exponent) : value / power_of_ten(exponent);
  return {with_minus_sign(fixed_decimals(mantissa, decimals)) + "×10", exponent};
}

/// Labels with just the decimals that the step needs.
std::vector<Tick> labelled(const std::vector<double>& values, Step step) {
  std::vector<Tick> ticks;
  const int exponent = decimal_exponent(std::max(std::abs(values.front()), std::abs(values.back())));
  for (const double value : values) {
    if (exponent >= 6 || exponent < -3) {
      ticks.push_back({value, scientific_label(value, exponent, exponent - step.exponent)});
    } else {
      ticks.push_back({value, {with_minus_sign(fixed_decimals(value, -step.exponent)), std::nullopt}});
    }
  }
  return ticks;
}

/// digit * 10^n inside the range, for the given digits and every n.
std::vector<double> digits_inside(Range range, const std::vector<int>& digits) {
  std::vector<double> values;
  for (int n = decimal_exponent(range.lo); n <= decimal_exponent(range.hi); ++n) {
    for (const int digit : digits) {
      const double value = Step{digit, n}.multiple(1);
      if (value >= range.lo && value <= range.hi) values.push_back(value);
    }
  }
  return values;
}

Ticks decade_ticks(const std::vector<double>& decades, int every) {
  Ticks ticks;
  for (const double decade : decades) {
    const int exponent = decimal_exponent(decade);
    if (exponent % every == 0) {
      ticks.major.push_back({decade, {"10", exponent}});
    } else {
      ticks.minor.push_back(decade);
    }
  }
  return ticks;
}

std::vector<Tick> digit_labels(const std::vector<double>& values) {
  const bool plain = values.front() >= 1e-3 && values.back() < 1e5;
  std::vector<Tick> ticks;
  for (const double value : values) {
    const int exponent = decimal_exponent(value);
    TickLabel label{"", std::nullopt};
    if (plain) {
      label.text = fixed_decimals(value, -exponent);
    } else {
      label = scientific_label(value, exponent, 0);
      if (label.text == "1×10") label.text = "10";
    }
    ticks.push_back({value, label});
  }
  return ticks;
}

void add_minor(Ticks& ticks, const std::vector<double>& candidates) {
  for (const double value : candidates) {
    const auto same = [&](const Tick& tick) { return tick.value == value; };
    if (std::none_of(ticks.major.begin(), ticks.major.end(), same)) ticks.minor.push_back(value);
  }
}

}  // namespace

Ticks linear_ticks(Range range, int target) {
  const Step step = best_step(range, target);
  return {labelled(multiples_inside(range, step), step), {}};
}

Ticks log_ticks(Range range) {
  const std::vector<double> decades = digits_inside(range, {1});
  const auto all = digits_inside(range, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  if (decades.size() >= kMinDecades) {
    const int every = (static_cast<int>(decades.size()) - 1) / kMaxTicks + 1;
    Ticks ticks = decade_ticks(decades, every);
    if (decades.size() <= kMaxMinorDecades) add_minor(ticks, all);
    return ticks;
  }
  for (const std::vector<int>& digits :
       {std::vector{1, 2, 5}, std::vector{1, 3}, std::vector{1, 2, 3, 5}, std::vector{1, 2, 3, 4, 5, 6, 7, 8, 9}}) {
    const auto values = digits_inside(range, digits);
    if (!good_count(values)) continue;
    Ticks ticks{digit_labels(values), {}};
    add_minor(ticks, all);
    return ticks;
  }
  return linear_ticks(range, 5);
}

}  // namespace vispline::report
