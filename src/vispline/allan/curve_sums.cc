#include "vispline/allan/curve_sums.h"

#include <algorithm>
#include <cmath>

#include "vispline/allan/overlapping.h"
#include "vispline/core/parallel.h"

namespace vispline {
namespace {

CurveSums streamed(const StreamCurve& stream) {
  CurveSums curve;
  for (const StreamCurve::Point& point : stream.points()) {
    curve.factors.push_back(point.m);
    curve.sums.push_back(point.sum);
  }
  return curve;
}

double log_deviation(const CurveSums& curve, std::size_t i) {
  return std::log(deviation(Deviation::kOadev, curve.sums[i], curve.factors[i], 1.0));
}

}  // namespace

std::vector<CurveSums> overlapping_curves(const AllanRecord& record, std::span<const std::int64_t> factors,
                                          std::size_t threads) {
  std::vector<CurveSums> curves;
  for (std::size_t a = 0; a < record.axes(); ++a) {
    curves.push_back(record.held() ? CurveSums{{factors.begin(), factors.end()}, {}} : streamed(record.stream(a)));
    curves[a].sums.resize(curves[a].factors.size());
  }
  if (!record.held()) return curves;
  for (std::size_t segment = 0; segment < record.lengths().size(); ++segment) {
    std::vector<Phase> phases(record.axes());
    parallel_for(record.axes(), threads, [&](std::size_t a) { phases[a] = record.phase(a, segment); });
    const std::vector<std::span<const double>> views(phases.begin(), phases.end());
    const auto sums = overlapping_sums(views, factors, threads);
    for (std::size_t a = 0; a < record.axes(); ++a) {
      for (std::size_t i = 0; i < factors.size(); ++i) curves[a].sums[i] += sums[a][i];
    }
  }
  return curves;
}

CurveSums curve_sums(const AllanRecord& record, std::size_t axis, Deviation kind,
                     std::span<const std::int64_t> factors) {
  CurveSums curve{{factors.begin(), factors.end()}, std::vector<SquaredSum>(factors.size())};
  for (std::size_t segment = 0; segment < record.lengths().size(); ++segment) {
    const Phase phase = record.phase(axis, segment);
    for (std::size_t i = 0; i < factors.size(); ++i) curve.sums[i] += squared_sum(kind, phase, factors[i]);
  }
  return curve;
}

CurveSums points_at(const CurveSums& curve, std::span<const std::int64_t> grid) {
  CurveSums kept;
  for (std::size_t i = 0; i < curve.factors.size(); ++i) {
    if (!std::binary_search(grid.begin(), grid.end(), curve.factors[i])) continue;
    kept.factors.push_back(curve.factors[i]);
    kept.sums.push_back(curve.sums[i]);
  }
  return kept;
}

std::vector<double> deviations_at(const CurveSums& curve, std::span<const std::int64_t> factors) {
  std::vector<double> values;
  for (const std::int64_t m : factors) {
    const auto at = std::lower_bound(curve.factors.begin(), curve.factors.end(), m);
    if (at == curve.factors.end()) break;
    const auto i = static_cast<std::size_t>(at - curve.factors.begin());
    const double right = log_deviation(curve, i);
    if (*at == m || i == 0) {
      values.push_back(std::exp(right));
      continue;
    }
    const double left = log_deviation(curve, i - 1), begin = static_cast<double>(curve.factors[i - 1]);
    const double share = std::log(static_cast<double>(m) / begin) / std::log(static_cast<double>(*at) / begin);
    values.push_back(std::exp(left + share * (right - left)));
  }
  return values;
}

}  // namespace vispline
