/// Quantiles of the chi-square distribution and the intervals of a variance they give. docs/math/allan.md (13).
#pragma once

namespace vispline {

/// P(chi^2 with `dof` > 0 degrees of freedom <= x).
double chi_square_cdf(double x, double dof);

/// The x below which chi^2 falls with probability p in (0, 1); dof > 0 need not be an integer.
double chi_square_quantile(double p, double dof);

/// A standard deviation estimated with `edf` degrees of freedom lies between low and high times its estimate with this
/// two-sided confidence.
struct IntervalFactors {
  double low, high;
};
IntervalFactors deviation_interval(double edf, double confidence);

}  // namespace vispline
