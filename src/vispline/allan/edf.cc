#include "vispline/allan/edf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vispline {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// A sum over more lags than this is taken as the integral it approximates, as Greenhall and Riley do.
constexpr double kMaxLags = 100.0;
/// Lags that the integral is sampled at.
constexpr double kIntegralLags = 600.0;

double log_or_zero(double x) { return x > 0.0 ? std::log(x) : 0.0; }

/// Generalised autocovariance of the noise integrated once more, up to a factor: Greenhall and Riley (10).
double sw(double t, int alpha) {
  const double a = std::abs(t), square = t * t;
  switch (alpha) {
    case 2:
      return -a;
    case 1:
      return square * log_or_zero(a);
    case 0:
      return a * square;
    case -1:
      return -square * square * log_or_zero(a);
    case -2:
      return -a * square * square;
    case -3:
      return square * square * square * log_or_zero(a);
    default:
      return a * square * square * square;
  }
}

/// Autocovariance of the phase averaged over 1/F of the averaging time.
double sx(double t, double F, int alpha) {
  if (std::isinf(F)) return sw(t, alpha + 2);
  return F * F * (2.0 * sw(t, alpha) - sw(t - 1.0 / F, alpha) - sw(t + 1.0 / F, alpha));
}

/// Autocovariance of the d-th difference of the phase.
double sz(double t, double F, int alpha, int d) {
  const auto pair = [&](int k) { return sx(t - k, F, alpha) + sx(t + k, F, alpha); };
  if (d == 2) return 6.0 * sx(t, F, alpha) - 4.0 * pair(1) + pair(2);
  return 20.0 * sx(t, F, alpha) - 15.0 * pair(1) + 6.0 * pair(2) - pair(3);
}

/// What of the deviation decides the covariance of its differences.
struct Shape {
  int d;          ///< order of the differences
  bool modified;  ///< averaged over m starts
  double stride;  ///< S: starts per averaging time
};

Shape shape_of(Deviation kind, double m) {
  switch (kind) {
    case Deviation::kAdev:
      return {2, false, 1.0};
    case Deviation::kMdev:
    case Deviation::kTdev:
      return {2, true, m};
    case Deviation::kHdev:
      return {3, false, 1.0};
    case Deviation::kOhdev:
      return {3, false, m};
    default:
      return {2, false, m};
  }
}

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

/// White phase: differences correlate only at whole averaging times, where two of their points coincide.
double inverse_edf_white_phase(int d, double M, double r) {
  double sum = 1.0;
  const double peak = binomial(2 * d, d);
  for (int k = 1; k <= d && k < r; ++k) {
    const double correlation = binomial(2 * d, d - k) / peak;
    sum += 2.0 * (1.0 - k / r) * correlation * correlation;
  }
  return sum / M;
}

struct Lags {
  double M;  ///< differences
  double S;  ///< per averaging time
  double J;  ///< lags that matter
};

/// A long sum as one over kIntegralLags lags of the same reach.
Lags limited(double M, double S, int d) {
  const double r = M / S;
  const double reach = std::min(r, d + 1.0);
  if (reach * S <= kMaxLags) return {M, S, std::min(M, (d + 1.0) * S)};
  const double density = kIntegralLags / reach;
  return {r * density, density, kIntegralLags};
}

/// The averaging width of the phase in the sum: a width below the lags' own spacing does not show, except that the
/// variance of flicker phase grows with its logarithm.
double width(const Shape& shape, int alpha, double m, const Lags& lags) {
  if (shape.modified) return 1.0;
  if (alpha >= 1) return std::min(m, std::max(lags.S, 1.0));
  return m * (shape.d + 1) <= kMaxLags ? m : kInfinite;
}

}  // namespace

double edf_of(Deviation kind, std::span<const NoiseShare> noise, std::int64_t factor, std::int64_t points) {
  const auto m = static_cast<double>(factor);
  const Shape shape = shape_of(kind, m);
  const double F = shape.modified ? 1.0 : m;
  const double L = m / F + m * shape.d;
  const double M = 1.0 + std::floor(shape.stride * (static_cast<double>(points) - L) / m);
  if (M <= 1.0) return 1.0;
  const double r = M / shape.stride;
  const Lags lags = limited(M, shape.stride, shape.d);
  const int lowest = shape.d == 2 ? -2 : -4;

  struct Part {
    int alpha;
    double share, width, variance;
  };
  std::array<Part, 8> parts{};
  std::size_t used = 0;
  double white_phase = 0.0;
  for (const NoiseShare& entry : noise) {
    const int alpha = std::clamp(entry.alpha, lowest, 2);
    if (entry.share <= 0.0 || used == parts.size()) continue;
    if (alpha == 2 && !shape.modified) {
      white_phase += entry.share;
      continue;
    }
    const double w = width(shape, alpha, m, lags);
    const double full = alpha == 1 && !shape.modified ? m : w;
    parts[used++] = {alpha, entry.share, w, sz(0.0, full, alpha, shape.d)};
  }
  const auto correlation = [&](double t) {
    double value = 0.0;
    for (std::size_t i = 0; i < used; ++i) {
      value += parts[i].share * sz(t, parts[i].width, parts[i].alpha, shape.d) / parts[i].variance;
    }
    return value;
  };
  double sum = 0.0;
  if (used > 0) {
    const auto last = static_cast<int>(lags.J);
    const double at_zero = correlation(0.0), at_end = correlation(lags.J / lags.S);
    sum = at_zero * at_zero + (1.0 - lags.J / lags.M) * at_end * at_end;
    for (int j = 1; j < last; ++j) {
      const double c = correlation(j / lags.S);
      sum += 2.0 * (1.0 - j / lags.M) * c * c;
    }
    sum /= lags.M;
  }
  sum += white_phase * white_phase * inverse_edf_white_phase(shape.d, M, r);
  return std::max(1.0, 1.0 / sum);
}

double edf_of(Deviation kind, int alpha, std::int64_t m, std::int64_t points) {
  if (kind == Deviation::kTotdev && alpha <= 0 && 2 * m > 16) {
    // Howe's edf = b T / tau - c for total deviation. NIST SP 1065, table 7.
    const double ratio = static_cast<double>(points - 1) / static_cast<double>(m);
    const double b = alpha == 0 ? 1.50 : alpha == -1 ? 1.17 : 0.93;
    const double c = alpha == 0 ? 0.0 : alpha == -1 ? 0.22 : 0.36;
    return std::max(1.0, b * ratio - c);
  }
  const NoiseShare one{alpha, 1.0};
  return edf_of(kind, std::span(&one, 1), m, points);
}

}  // namespace vispline
