/// Sigmas beside scatter that was found in other ways. docs/math/uncertainty.md, Jack-knife and Twin.
#pragma once

#include <string>
#include <vector>

namespace vispline {

/// One estimated number.
struct ComponentSpread {
  std::string label{};  ///< "cam0.T_c_i.rotation x"
  std::string unit{};
  double sigma = 0.0;     ///< of the information matrix
  double spread = 0.0;    ///< standard deviation that was found
  double coverage = 0.0;  ///< share of runs whose 95 % interval holds the truth; of the twin only
};

/// How far single blocks of time pull the estimate.
struct Jackknife {
  int blocks = 0;
  std::vector<ComponentSpread> components{};
};

/// The estimate simulated again many times, and estimated again.
struct Twin {
  int runs = 0;
  int failed = 0;
  int states = 0;         ///< numbers that are estimated
  double nees = 0.0;      ///< mean of e^T Sigma^-1 e over states: 1 if sigmas are right
  double nees_low = 0.0;  ///< two-sided 99 % band of that mean
  double nees_high = 0.0;
  double coverage = 0.0;  ///< of 95 % intervals, over all numbers and runs
  std::vector<ComponentSpread> components{};

  bool consistent() const { return nees >= nees_low && nees <= nees_high; }
};

/// Two-sided band of a mean of `runs` normalised squared errors of `states` numbers each, over `states`: quantiles of
/// chi-square by Wilson and Hilferty (1931). `sigmas`: 2.5758 for 99 %.
struct Band {
  double low = 0.0, high = 0.0;
};
Band nees_band(int states, int runs, double sigmas = 2.5758293035489004);

}  // namespace vispline
