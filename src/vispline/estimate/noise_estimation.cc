#include "vispline/estimate/noise_estimation.h"

#include <cmath>

#include "vispline/core/random.h"
#include "vispline/estimate/normal_equations.h"

namespace vispline {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr double kLeastRedundancy = 0.05;  // of the rows

}  // namespace

std::map<std::string, SensorFit> sensor_fits(const Problem& problem, const State& state, const Columns& columns,
                                             std::size_t threads, int probes) {
  std::map<std::string, SensorFit> fits;
  std::map<std::string, Eigen::MatrixXd> pulled;  // J^T z, one column a probe
  Rows rows;
  for (std::size_t m = 0; m < problem.measurements.size(); ++m) {
    const Measurement& measurement = *problem.measurements[m];
    measurement.evaluate(state, columns, true, rows);
    const std::vector<std::string> names = measurement.sensors();
    std::vector<SensorFit*> fit;
    std::vector<Eigen::MatrixXd*> sum;
    for (const std::string& name : names) {
      fit.push_back(&fits[name]);
      sum.push_back(&pulled.try_emplace(name, Eigen::MatrixXd::Zero(columns.layout.columns, probes)).first->second);
    }
    const RandomStream signs(kSeed, "noise/" + std::to_string(m));
    for (Eigen::Index i = 0; i < rows.r.size(); ++i) {
      const std::size_t s = measurement.sensor_of(i);
      if (rows.weight(i) <= 0.0) continue;
      ++fit[s]->rows;
      fit[s]->chi2 += rows.weight(i) * rows.r(i) * rows.r(i);
      const Eigen::VectorXd row = std::sqrt(rows.weight(i)) * rows.J.row(i).transpose();
      for (int p = 0; p < probes; ++p) {
        const auto draw =
            static_cast<std::uint64_t>(i) * static_cast<std::uint64_t>(probes) + static_cast<std::uint64_t>(p);
        const double sign = signs.normal(draw) < 0.0 ? -1.0 : 1.0;
        for (std::size_t c = 0; c < rows.column.size(); ++c) {
          (*sum[s])(rows.column[c], p) += sign * row(static_cast<Eigen::Index>(c));
        }
      }
    }
  }
  const NormalEquations equations(problem, state, columns, threads);
  for (auto& [name, fit] : fits) {
    const auto solved = equations.solve(pulled.at(name));
    if (!solved) return {};
    fit.redundancy = static_cast<double>(fit.rows) - pulled.at(name).cwiseProduct(*solved).sum() / probes;
  }
  return fits;
}

void rescale_sigma(double& sigma, const std::string& sensor, const std::map<std::string, SensorFit>& fits) {
  const auto fit = fits.find(sensor);
  if (fit != fits.end() && fit->second.redundancy > kLeastRedundancy * static_cast<double>(fit->second.rows)) {
    sigma *= std::sqrt(fit->second.chi2_per_redundancy());
  }
}

void rescale_sigma(ImuSigma& sigma, const std::string& imu, const std::map<std::string, SensorFit>& fits) {
  rescale_sigma(sigma.gyro, imu + ".gyroscope", fits);
  rescale_sigma(sigma.accel, imu + ".accelerometer", fits);
}

}  // namespace vispline
