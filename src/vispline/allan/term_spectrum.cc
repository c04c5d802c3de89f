#include "vispline/allan/term_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace vispline {
namespace {

constexpr double kPi = std::numbers::pi;
/// Below this index the leakage of flicker shows.
constexpr std::int64_t kLeakage = 32;
/// Long enough for E[z_j^2] length to no longer depend on the length.
constexpr std::int64_t kLong = 2048;

double square_log(double t) { return t == 0.0 ? 0.0 : t * t * std::log(std::abs(t)); }

/// Covariance at lag h of the differences of averaged flicker, B = 1: docs/math/allan.md (17).
double flicker_covariance(std::int64_t lag) {
  const auto h = static_cast<double>(lag);
  const double fourth = 6.0 * square_log(h) - 4.0 * (square_log(h - 1.0) + square_log(h + 1.0)) + square_log(h - 2.0) +
                        square_log(h + 2.0);
  return fourth / (2.0 * kPi);
}

/// docs/math/allan.md (18): the expectation of z_j^2, edges included.
double expected_flicker(std::int64_t length, std::int64_t j) {
  const auto n = static_cast<double>(length);
  const double theta = kPi * static_cast<double>(j) / n;
  double sum = flicker_covariance(0);
  for (std::int64_t h = 1; h + 2 <= length; ++h) {
    const auto lag = static_cast<double>(h);
    const double weight =
        (n - 1.0 - lag) * std::cos(lag * theta) / n + std::sin((lag + 1.0) * theta) / (n * std::sin(theta));
    sum += 2.0 * flicker_covariance(h) * weight;
  }
  return sum;
}

const std::vector<double>& long_flicker() {
  static const std::vector<double> table = [] {
    std::vector<double> values;
    for (std::int64_t j = 0; j <= kLeakage; ++j) {
      values.push_back(j == 0 ? 0.0 : expected_flicker(kLong, j) * static_cast<double>(kLong));
    }
    return values;
  }();
  return table;
}

double inverse_cube(double x) { return 1.0 / (x * x * x); }

/// docs/math/allan.md (16): lambda^2 sum over m of |theta + 2 pi m|^-3, the far folds as their integral.
double flicker_density(double theta, double lambda) {
  constexpr int kFolds = 6;
  double sum = inverse_cube(theta);
  for (int m = 1; m <= kFolds; ++m) {
    sum += inverse_cube(2.0 * kPi * m + theta) + inverse_cube(2.0 * kPi * m - theta);
  }
  const double tail = 2.0 * kPi * (kFolds + 0.5);
  sum += 1.0 / (2.0 * kPi * tail * tail);
  return lambda * lambda * sum;
}

double flicker_power(std::int64_t length, std::int64_t j, double theta, double lambda) {
  if (j > kLeakage) return flicker_density(theta, lambda);
  if (length < kLong) return expected_flicker(length, j);
  return long_flicker()[static_cast<std::size_t>(j)] / static_cast<double>(length);
}

}  // namespace

TermPowers term_powers(const DifferencedSeries& series, std::int64_t j) {
  const double theta = kPi * static_cast<double>(j) / static_cast<double>(series.length);
  const double lambda = 4.0 * std::sin(0.5 * theta) * std::sin(0.5 * theta);
  const double dt = series.step_s;
  const auto L = static_cast<double>(series.averaged);
  return {lambda * lambda / (dt * dt), lambda / dt, flicker_power(series.length, j, theta, lambda),
          dt * (1.0 - lambda * (L * L - 1.0) / (6.0 * L * L))};
}

double ramp_mean(const DifferencedSeries& series, std::int64_t j) {
  if (j % 2 == 0) return 0.0;
  const auto n = static_cast<double>(series.length);
  return std::sqrt(2.0 / n) * series.step_s / std::tan(kPi * static_cast<double>(j) / (2.0 * n));
}

}  // namespace vispline
