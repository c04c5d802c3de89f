#include "vispline/allan/chi_square.h"

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/SpecialFunctions>

namespace vispline {
namespace {

/// Above this the cube-root normal approximation of Wilson and Hilferty is better than 1e-6 and the series are slow.
constexpr double kLargeDof = 1e5;

double normal_quantile(double p) { return Eigen::numext::ndtri(p); }

}  // namespace

double chi_square_cdf(double x, double dof) { return x <= 0.0 ? 0.0 : Eigen::numext::igamma(0.5 * dof, 0.5 * x); }

double chi_square_quantile(double p, double dof) {
  const double spread = 2.0 / (9.0 * dof);
  const double start = dof * std::pow(std::max(1e-3, 1.0 - spread + normal_quantile(p) * std::sqrt(spread)), 3.0);
  if (dof > kLargeDof) return start;
  double low = 0.0, high = 2.0 * start + 10.0;
  while (chi_square_cdf(high, dof) < p) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_square_cdf(middle, dof) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

IntervalFactors deviation_interval(double edf, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  return {std::sqrt(edf / chi_square_quantile(1.0 - tail, edf)), std::sqrt(edf / chi_square_quantile(tail, edf))};
}

}  // namespace vispline
