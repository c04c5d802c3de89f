#include "vispline/estimate/noise_estimation.h"

#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/parallel.h"
#include "vispline/core/random.h"

namespace vispline {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::size_t kChunks = 4;
constexpr double kLeastRedundancy = 0.05;  // of the rows

/// Random signs of one row: probe p has bit p of a pair of uniform numbers.
class Signs {
 public:
  static constexpr int kMost = 64;
  Signs(const RandomStream& stream, Eigen::Index row) {
    for (const double u : stream.uniform_pair(static_cast<std::uint64_t>(row))) {
      bits_ = (bits_ << 32) | static_cast<std::uint32_t>(std::ldexp(u, 32) - 0.5);
    }
  }
  double of(int probe) const { return (bits_ >> probe & 1) != 0 ? 1.0 : -1.0; }

 private:
  std::uint64_t bits_ = 0;
};

/// Of one sensor, or a part of its rows.
struct Gathered {
  SensorFit fit{};
  Eigen::MatrixXd pulled{};  ///< J^T z, one column a probe
};
using BySensor = std::map<std::string, Gathered>;

/// Adds the rows of measurement number m.
void gather(const Measurement& measurement, std::size_t m, const Rows& rows, int columns, int probes, BySensor& all) {
  const std::vector<std::string> names = measurement.sensors();
  std::vector<Gathered*> sensor;
  for (const std::string& name : names) {
    sensor.push_back(&all[name]);
    if (sensor.back()->pulled.size() == 0) sensor.back()->pulled.setZero(columns, probes);
  }
  const RandomStream stream(kSeed, "noise/" + std::to_string(m));
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(rows.r.size(), probes * static_cast<int>(names.size()));
  for (Eigen::Index i = 0; i < rows.r.size(); ++i) {
    if (rows.weight(i) <= 0.0) continue;
    const std::size_t s = measurement.sensor_of(i);
    ++sensor[s]->fit.rows;
    sensor[s]->fit.chi2 += rows.weight(i) * rows.r(i) * rows.r(i);
    const Signs sign(stream, i);
    const double root = std::sqrt(rows.weight(i));
    for (int p = 0; p < probes; ++p) Z(i, static_cast<int>(s) * probes + p) = root * sign.of(p);
  }
  const Eigen::MatrixXd pulled = rows.pull(Z);
  for (std::size_t s = 0; s < names.size(); ++s) {
    for (std::size_t c = 0; c < rows.column.size(); ++c) {
      sensor[s]->pulled.row(rows.column[c]) +=
          pulled.block(static_cast<Eigen::Index>(c), static_cast<int>(s) * probes, 1, probes);
    }
  }
}

BySensor gather(const Problem& problem, const State& state, const Columns& columns, std::size_t threads, int probes) {
  std::vector<BySensor> part(kChunks);
  parallel_for(kChunks, threads, [&](std::size_t chunk) {
    Rows rows;
    const std::size_t count = problem.measurements.size();
    for (std::size_t m = count * chunk / kChunks; m < count * (chunk + 1) / kChunks; ++m) {
      problem.measurements[m]->evaluate(state, columns, true, rows);
      gather(*problem.measurements[m], m, rows, columns.layout.columns, probes, part[chunk]);
    }
  });
  BySensor all = std::move(part.front());
  for (std::size_t chunk = 1; chunk < kChunks; ++chunk) {
    for (auto& [name, more] : part[chunk]) {
      const auto [at, added] = all.try_emplace(name, std::move(more));
      if (added) continue;
      at->second.fit.rows += more.fit.rows;
      at->second.fit.chi2 += more.fit.chi2;
      at->second.pulled += more.pulled;
    }
  }
  return all;
}

}  // namespace

std::map<std::string, SensorFit> sensor_fits(const Problem& problem, const State& state, const Columns& columns,
                                             const NormalEquations& equations, std::size_t threads, int probes) {
  require(probes >= 1 && probes <= Signs::kMost, "1 to 64 probes");
  const BySensor sensors = gather(problem, state, columns, threads, probes);
  Eigen::MatrixXd pulled(columns.layout.columns, probes * static_cast<int>(sensors.size()));
  int at = 0;
  for (const auto& [name, sensor] : sensors) pulled.middleCols(probes * at++, probes) = sensor.pulled;
  std::map<std::string, SensorFit> fits;
  const auto solved = equations.solve(pulled);
  if (!solved) return fits;
  at = 0;
  for (const auto& [name, sensor] : sensors) {
    fits[name] = sensor.fit;
    const double absorbed = sensor.pulled.cwiseProduct(solved->middleCols(probes * at++, probes)).sum() / probes;
    fits[name].redundancy = static_cast<double>(sensor.fit.rows) - absorbed;
  }
  return fits;
}

std::map<std::string, SensorFit> sensor_fits(const Problem& problem, const State& state, const Columns& columns,
                                             std::size_t threads, int probes) {
  return sensor_fits(problem, state, columns, NormalEquations(problem, state, columns, threads), threads, probes);
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

void rescale_sigma(std::vector<double>& sigma_px, const Problem& problem, const State& state) {
  std::vector<double> chi2(sigma_px.size()), redundancy(sigma_px.size());
  for (const Track& track : problem.tracks) {
    const TrackResiduals residuals = evaluate_track(state, problem.track_model, track);
    const double own = static_cast<double>(problem.track_model.size()) / static_cast<double>(track.sightings.size());
    for (std::size_t i = 0; i < track.sightings.size(); ++i) {
      const double s = residuals.r[i].squaredNorm();
      chi2[track.sightings[i].camera] += problem.track_model.loss.weight(s) * s;
      redundancy[track.sightings[i].camera] += 2.0 - own;
    }
  }
  for (std::size_t c = 0; c < sigma_px.size(); ++c) {
    if (redundancy[c] > 0.0 && chi2[c] > 0.0) sigma_px[c] *= std::sqrt(chi2[c] / redundancy[c]);
  }
}

}  // namespace vispline
