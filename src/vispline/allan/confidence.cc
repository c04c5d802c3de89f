#include "vispline/allan/confidence.h"

#include <algorithm>
#include <cmath>

#include "vispline/allan/chi_square.h"
#include "vispline/allan/edf.h"
#include "vispline/allan/noise_type.h"

namespace vispline {
namespace {

constexpr int kAlphaOfTerm[kTerms] = {2, 0, -1, -2, -2};

/// Of the differences at factor m in each segment that is long enough: degrees of freedom of their pooled sum. The
/// variances of the segments add by share.
double pooled_edf(Deviation kind, std::span<const NoiseShare> noise, std::int64_t m,
                  std::span<const std::int64_t> lengths) {
  const std::int64_t needed = points_needed(kind, m);
  double total = 0.0, inverse = 0.0;
  for (const std::int64_t length : lengths) {
    if (length + 1 >= needed) total += static_cast<double>(length + 2 - needed);
  }
  for (const std::int64_t length : lengths) {
    if (length + 1 < needed) continue;
    const double share = static_cast<double>(length + 2 - needed) / total;
    const double edf =
        kind == Deviation::kTotdev ? edf_of(kind, noise[0].alpha, m, length + 1) : edf_of(kind, noise, m, length + 1);
    inverse += share * share / edf;
  }
  return inverse > 0.0 ? 1.0 / inverse : 1.0;
}

std::vector<NoiseShare> shares(const NoiseTerms& terms, double tau_s) {
  std::vector<NoiseShare> parts;
  const double total = terms.deviation(tau_s);
  for (std::size_t i = 0; i < kTerms && total > 0.0; ++i) {
    const double part = deviation_of(static_cast<Term>(i), terms.term[i].value, tau_s) / total;
    if (part > 0.0) parts.push_back({kAlphaOfTerm[i], part * part});
  }
  if (parts.empty()) parts.push_back({0, 1.0});
  return parts;
}

/// `noise_at(m)` gives the parts of the noise at factor m; it is called once for each factor, in order.
template <class NoiseAt>
AllanCurve curve_with(Deviation kind, const CurveSums& sums, std::span<const std::int64_t> lengths, double rate_hz,
                      const NoiseAt& noise_at) {
  AllanCurve curve;
  curve.deviation = kind;
  for (std::size_t i = 0; i < sums.factors.size(); ++i) {
    const std::int64_t m = sums.factors[i];
    const double value = deviation(kind, sums.sums[i], m, 1.0) * (kind == Deviation::kTdev ? 1.0 / rate_hz : 1.0);
    if (!std::isfinite(value)) continue;
    const double edf = pooled_edf(kind, noise_at(m), m, lengths);
    const IntervalFactors interval = deviation_interval(edf, kCurveConfidence);
    curve.tau_s.push_back(static_cast<double>(m) / rate_hz);
    curve.value.push_back(value);
    curve.low.push_back(value * interval.low);
    curve.high.push_back(value * interval.high);
    curve.edf.push_back(edf);
    curve.count.push_back(sums.sums[i].count);
  }
  return curve;
}

}  // namespace

AllanCurve curve_by_terms(Deviation kind, const CurveSums& sums, std::span<const std::int64_t> lengths, double rate_hz,
                          const NoiseTerms& terms) {
  return curve_with(kind, sums, lengths, rate_hz,
                    [&](std::int64_t m) { return shares(terms, static_cast<double>(m) / rate_hz); });
}

AllanCurve curve_by_noise_type(Deviation kind, const CurveSums& sums, std::span<const std::int64_t> lengths,
                               double rate_hz, std::span<const double> longest_phase) {
  int alpha = 2;
  return curve_with(kind, sums, lengths, rate_hz, [&](std::int64_t m) {
    alpha = std::min(alpha, noise_alpha(longest_phase, m).value_or(alpha));
    return std::vector<NoiseShare>{{alpha, 1.0}};
  });
}

MinimumDeviation minimum_of(const AllanCurve& curve) {
  MinimumDeviation minimum;
  for (std::size_t i = 0; i < curve.tau_s.size(); ++i) {
    if (i == 0 || curve.value[i] < minimum.deviation) minimum = {curve.tau_s[i], curve.value[i]};
  }
  return minimum;
}

}  // namespace vispline
