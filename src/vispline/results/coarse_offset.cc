#include "vispline/results/coarse_offset.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace vispline {
namespace {

constexpr double kMaxParts = 256;             // values averaged for one grid point
constexpr double kMinOverlap = 0.5;           // of the shorter signal
constexpr double kMinVariance = 0.1;          // of a signal's variance must be left in the overlap
constexpr double kPerfectCorrelation = 0.01;  // 1 - r^2 below which a longer overlap decides

using Spectrum = std::vector<std::complex<double>>;

/// |angular rate| on a uniform grid, as 0 where `mask` is 0: in gaps.
struct Grid {
  std::vector<double> value, mask;
  double samples = 0.0;
};

double mean_norm(const ImuSpline& imu, double begin_s, double step_s, int parts) {
  double sum = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double seconds = begin_s + k * step_s / parts;
    const std::optional<std::size_t> interval = imu.interval(seconds);
    if (!interval) return -1.0;
    sum += imu.value(*interval, seconds).head<3>().norm();
  }
  return sum / parts;
}

/// Shifts and scales the values to mean 0 and variance 1, which keeps the sums of squares well conditioned.
void standardise(Grid& grid) {
  double sum = 0.0, squares = 0.0;
  for (const double value : grid.value) sum += value;
  const double mean = sum / grid.samples;
  for (std::size_t i = 0; i < grid.value.size(); ++i) {
    grid.value[i] = grid.mask[i] * (grid.value[i] - mean);
    squares += grid.value[i] * grid.value[i];
  }
  const double deviation = std::sqrt(squares / grid.samples);
  const bool varies = deviation > 1e-9 * (1e-9 + std::abs(mean));
  for (double& value : grid.value) value = varies ? value / deviation : 0.0;
}

Grid sample_norm(const ImuSpline& imu, double step_s, int parts) {
  Grid grid;
  const auto size = static_cast<std::size_t>(imu.duration_s() / step_s) + 1;
  for (std::size_t i = 0; i < size; ++i) {
    const double norm = mean_norm(imu, static_cast<double>(i) * step_s, step_s, parts);
    grid.value.push_back(norm < 0.0 ? 0.0 : norm);
    grid.mask.push_back(norm < 0.0 ? 0.0 : 1.0);
    grid.samples += grid.mask.back();
  }
  if (grid.samples > 0.0) standardise(grid);
  return grid;
}

std::vector<double> squared(std::vector<double> values) {
  for (double& value : values) value *= value;
  return values;
}

/// The sums over the overlap at every lag, by FFT: sums(x, y)[lag mod size] = sum_i x_i y_{i + lag}.
class LagSums {
 public:
  explicit LagSums(std::size_t size) : size_(size) { fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum); }
  Spectrum transform(std::vector<double> values) {
    values.resize(size_, 0.0);
    Spectrum spectrum;
    fft_.fwd(spectrum, values);
    return spectrum;
  }
  std::vector<double> operator()(const Spectrum& x, const Spectrum& y) {
    Spectrum product(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) product[i] = std::conj(x[i]) * y[i];
    std::vector<double> sums(size_);
    fft_.inv(sums, product, static_cast<Eigen::Index>(size_));
    return sums;
  }

 private:
  std::size_t size_;
  Eigen::FFT<double> fft_;
};

/// Correlation and number of overlapping grid points at the lags first_lag, first_lag + 1, ...
struct Correlogram {
  std::int64_t first_lag = 0;
  std::vector<double> correlation;  ///< 0 where too little overlaps
  std::vector<double> overlap;
};

double pearson(double n, double x, double y, double xx, double yy, double xy) {
  const double vx = xx / n - (x / n) * (x / n), vy = yy / n - (y / n) * (y / n);
  if (vx < kMinVariance || vy < kMinVariance) return 0.0;
  return (xy / n - (x / n) * (y / n)) / std::sqrt(vx * vy);
}

/// docs/math/evaluate.md (18)
Correlogram correlate(const Grid& a, const Grid& b) {
  std::size_t size = 1;
  while (size < a.value.size() + b.value.size()) size *= 2;
  LagSums sums(size);
  const Spectrum a0 = sums.transform(a.mask), a1 = sums.transform(a.value), a2 = sums.transform(squared(a.value));
  const Spectrum b0 = sums.transform(b.mask), b1 = sums.transform(b.value), b2 = sums.transform(squared(b.value));
  const std::vector<double> n = sums(a0, b0), x = sums(a1, b0), y = sums(a0, b1), xx = sums(a2, b0), yy = sums(a0, b2),
                            xy = sums(a1, b1);
  const double min_overlap = std::max(2.0, kMinOverlap * std::min(a.samples, b.samples));
  Correlogram result;
  result.first_lag = 1 - static_cast<std::int64_t>(a.value.size());
  for (std::int64_t lag = result.first_lag; lag < static_cast<std::int64_t>(b.value.size()); ++lag) {
    const auto k = static_cast<std::size_t>(lag < 0 ? lag + static_cast<std::int64_t>(size) : lag);
    const bool enough = std::round(n[k]) >= min_overlap;
    result.overlap.push_back(enough ? std::round(n[k]) : 0.0);
    result.correlation.push_back(enough ? pearson(n[k], x[k], y[k], xx[k], yy[k], xy[k]) : 0.0);
  }
  return result;
}

void forbid_lags_outside(Correlogram& c, double step_s, LagRange range) {
  for (std::size_t i = 0; i < c.overlap.size(); ++i) {
    const double lag_s = static_cast<double>(c.first_lag + static_cast<std::int64_t>(i)) * step_s;
    if (lag_s < range.min_s || lag_s > range.max_s) c.overlap[i] = c.correlation[i] = 0.0;
  }
}

/// How much likelier the overlap is as one signal seen twice than as two.   docs/math/evaluate.md (19)
double score(const Correlogram& c, std::size_t i) {
  const double r = std::max(c.correlation[i], 0.0);
  return -c.overlap[i] * std::log(1.0 - std::min(r * r, 1.0) + kPerfectCorrelation);
}

/// Position of the maximum between three samples, in (-0.5, 0.5).
double parabola_peak(double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  return curvature < 0.0 ? std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5) : 0.0;
}

/// The highest correlation that is not on the slopes of the peak: beyond where it has fallen to half.
std::size_t second_peak(const Correlogram& c, std::size_t peak) {
  const double half = 0.5 * c.correlation[peak];
  std::size_t left = peak, right = peak;
  while (left > 0 && c.overlap[left - 1] > 0.0 && c.correlation[left] > half) --left;
  while (right + 1 < c.overlap.size() && c.overlap[right + 1] > 0.0 && c.correlation[right] > half) ++right;
  std::size_t second = c.correlation[left] > c.correlation[right] ? left : right;
  for (std::size_t i = 0; i < c.overlap.size(); ++i) {
    if ((i < left || i > right) && c.correlation[i] > c.correlation[second]) second = i;
  }
  return second;
}

CoarseOffset read_peak(const Correlogram& c, double step_s, std::size_t peak, double lags) {
  CoarseOffset found;
  const bool inside = peak > 0 && peak + 1 < c.overlap.size() && c.overlap[peak - 1] > 0.0 && c.overlap[peak + 1] > 0.0;
  const double fraction =
      inside ? parabola_peak(c.correlation[peak - 1], c.correlation[peak], c.correlation[peak + 1]) : 0.0;
  const auto lag = [&](std::size_t i) { return static_cast<double>(c.first_lag + static_cast<std::int64_t>(i)); };
  found.lag_s = (lag(peak) + fraction) * step_s;
  found.step_s = step_s;
  found.correlation = std::max(c.correlation[peak], 0.0);
  const std::size_t second = second_peak(c, peak);
  found.second_lag_s = lag(second) * step_s;
  found.second_correlation = std::max(c.correlation[second], 0.0);
  found.noise_correlation = std::sqrt(2.0 * std::log(lags + 1.0) / c.overlap[peak]);
  return found;
}

}  // namespace

std::optional<CoarseOffset> find_coarse_offset(const ImuSpline& first, const ImuSpline& second, double step_s,
                                               LagRange range, double max_points) {
  const double longest_s = std::max(first.duration_s(), second.duration_s());
  const double grid_s = std::max(step_s, longest_s / max_points);
  const int parts = static_cast<int>(std::min(std::ceil(grid_s / step_s), kMaxParts));
  Correlogram c = correlate(sample_norm(first, grid_s, parts), sample_norm(second, grid_s, parts));
  forbid_lags_outside(c, grid_s, range);
  std::optional<std::size_t> peak;
  double lags = 0.0;
  for (std::size_t i = 0; i < c.overlap.size(); ++i) {
    if (c.overlap[i] == 0.0) continue;
    lags += 1.0;
    if (!peak || score(c, i) > score(c, *peak)) peak = i;
  }
  if (!peak) return std::nullopt;
  return read_peak(c, grid_s, *peak, lags);
}

}  // namespace vispline
