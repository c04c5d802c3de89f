/// How large the noise of each sensor really is: variance components from the residuals. docs/math/estimate.md, Noise.
#pragma once

#include <map>
#include <string>

#include "vispline/estimate/imu_measurement.h"
#include "vispline/estimate/normal_equations.h"

namespace vispline {

struct SensorFit {
  std::size_t rows = 0;     ///< residuals that count
  double chi2 = 0.0;        ///< weighted sum of their squares
  double redundancy = 0.0;  ///< rows - what the unknowns absorb of them

  /// 1 if the sigmas were right.
  double chi2_per_redundancy() const { return redundancy > 0.0 ? chi2 / redundancy : 0.0; }
};

/// Of every sensor by its name, at a solution. The share of the unknowns is the trace of J H^-1 J^T over the sensor's
/// rows, found with `probes` random sign vectors (Hutchinson; 64 at most), the same ones for any number of threads.
/// Tracks are not in it: their landmarks absorb what they are. Empty if the information matrix has no full rank.
std::map<std::string, SensorFit> sensor_fits(const Problem& problem, const State& state, const Columns& columns,
                                             std::size_t threads, int probes = 4);
/// The same, with the problem already linearised at the state.
std::map<std::string, SensorFit> sensor_fits(const Problem& problem, const State& state, const Columns& columns,
                                             const NormalEquations& equations, std::size_t threads, int probes = 4);

/// sigma times the root of the sensor's chi2 per redundancy. With hardly any redundancy the size of the noise cannot be
/// told, and sigma stays.
void rescale_sigma(double& sigma, const std::string& sensor, const std::map<std::string, SensorFit>& fits);
void rescale_sigma(ImuSigma& sigma, const std::string& imu, const std::map<std::string, SensorFit>& fits);
/// Pixels of every camera, from its tracks: their redundancy is what their landmarks leave.
void rescale_sigma(std::vector<double>& sigma_px, const Problem& problem, const State& state);

}  // namespace vispline
