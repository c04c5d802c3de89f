#include "vispline/estimate/residual_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "vispline/estimate/absorbed.h"

namespace vispline {
namespace {

constexpr double kOutlierSigmas = 4.0;
constexpr double kBandSigmas = 3.29;  // 99.9 %

/// One reading of a sensor: its numbers in sigmas.
struct Reading {
  Time time{};
  std::vector<double> r{};
  std::vector<double> weight{};
  std::optional<Vector2d> px{};
};

struct Collected {
  SensorScale scale{};
  std::vector<Reading> readings{};
  std::int64_t lost = 0;
};

class Collector {
 public:
  void measurement(const Measurement& measurement, const State& state, const Columns& columns) {
    measurement.evaluate(state, columns, false, rows_);
    const std::vector<std::string> sensors = measurement.sensors();
    for (Eigen::Index row = 0; row < rows_.r.size(); ++row) {
      const std::size_t s = measurement.sensor_of(row);
      const SensorScale scale = measurement.scale_of(s);
      if (!(scale.sigma > 0.0)) continue;
      Collected& sensor = of(sensors[s], scale);
      const RowOrigin origin = measurement.origin_of(row);
      if (rows_.weight(row) == 0.0) {
        sensor.lost += origin.component == 0 ? 1 : 0;
        continue;
      }
      if (origin.component == 0) sensor.readings.push_back({origin.time, {}, {}, origin.px});
      sensor.readings.back().r.push_back(rows_.r(row));
      sensor.readings.back().weight.push_back(rows_.weight(row));
    }
  }

  void track(const Track& track, const TrackModel& model, const State& state) {
    const TrackResiduals residuals = evaluate_track(state, model, track);
    for (std::size_t i = 0; i < track.sightings.size(); ++i) {
      const Sighting& s = track.sightings[i];
      const Vector2d& r = residuals.r[i];
      Collected& sensor = of(state.rig.cameras[s.camera].name, {"px", model.sigma_px[s.camera]});
      const bool exact = i == 0 && model.unknowns == LandmarkUnknowns::kInverseDepth;
      if (exact || (residuals.lost > 0 && r.isZero(0.0))) {
        sensor.lost += exact ? 0 : 1;
        continue;
      }
      const double weight = model.loss.weight(r.squaredNorm());
      sensor.readings.push_back({s.stamp, {r.x(), r.y()}, {weight, weight}, s.px});
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  Collected& operator[](const std::string& name) { return by_name_[name]; }

 private:
  Collected& of(const std::string& name, const SensorScale& scale) {
    const auto [at, added] = by_name_.try_emplace(name, Collected{scale, {}, 0});
    if (added) names_.push_back(name);
    return at->second;
  }

  std::vector<std::string> names_;
  std::map<std::string, Collected> by_name_;
  Rows rows_;
};

/// Correlation of a number with the same number of the reading before, about zero.
double lag1_of(const std::vector<Reading>& readings) {
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (std::size_t k = 0; k < readings[i].r.size(); ++k) {
      const double r = std::sqrt(readings[i].weight[k]) * readings[i].r[k];
      squares += r * r;
      if (i > 0) products += r * std::sqrt(readings[i - 1].weight[k]) * readings[i - 1].r[k];
    }
  }
  return squares > 0.0 ? products / squares : 0.0;
}

SensorResiduals statistics(const std::string& name, Collected& collected, double absorbed, Time begin) {
  std::stable_sort(collected.readings.begin(), collected.readings.end(),
                   [](const Reading& a, const Reading& b) { return a.time < b.time; });
  SensorResiduals out;
  out.sensor = name;
  out.unit = collected.scale.unit;
  out.sigma = collected.scale.sigma;
  out.lost = collected.lost;
  double squares = 0.0, weighted = 0.0;
  out.residual.resize(collected.readings.empty() ? 0 : collected.readings.front().r.size());
  for (const Reading& reading : collected.readings) {
    out.time_s.push_back(to_seconds(reading.time - begin));
    if (reading.px) out.px.push_back(*reading.px);
    for (std::size_t k = 0; k < reading.r.size(); ++k) {
      const double r = reading.r[k];
      out.residual[k].push_back(out.sigma * r);
      squares += r * r;
      weighted += reading.weight[k] * r * r;
      ++out.count;
      if (std::abs(r) > kOutlierSigmas) ++out.outliers;
    }
  }
  const auto n = static_cast<double>(out.count);
  if (out.count == 0) return out;
  out.rms = out.sigma * std::sqrt(squares / n);
  out.dof = n - absorbed;
  out.chi2_per_dof = out.dof > 0.0 ? weighted / out.dof : 0.0;
  out.lag1 = lag1_of(collected.readings);
  // What the unknowns absorbed is taken from neighbours alike: white noise leaves residuals that lean to the negative,
  // by no more than its share.
  out.lag1_high = kBandSigmas / std::sqrt(n);
  out.lag1_low = -out.lag1_high - std::clamp(absorbed / n, 0.0, 1.0);
  return out;
}

/// What the rig says, before sigmas were found from residuals.
std::map<std::string, double> sigmas_of(const Rig& rig) {
  std::map<std::string, double> sigma;
  for (const Imu& imu : rig.imus) {
    sigma[imu.name + ".gyroscope"] = imu.noise.gyro.white * std::sqrt(imu.rate_hz);
    sigma[imu.name + ".accelerometer"] = imu.noise.accel.white * std::sqrt(imu.rate_hz);
  }
  for (const Camera& camera : rig.cameras) sigma[camera.name] = camera.pixel_sigma_px;
  return sigma;
}

}  // namespace

std::vector<SensorResiduals> residual_statistics(const Problem& problem, const Solution& solution,
                                                 const NormalEquations& equations, std::size_t threads) {
  Collector collector;
  for (const auto& m : problem.measurements) collector.measurement(*m, solution.state, solution.columns);
  for (const Track& track : problem.tracks) collector.track(track, problem.track_model, solution.state);
  const std::map<std::string, double> absorbed = absorbed_by_sensor(problem, solution, equations, threads);
  const std::map<std::string, double> rig_sigma = sigmas_of(problem.start.rig);
  std::vector<SensorResiduals> all;
  for (const std::string& name : collector.names()) {
    const auto at = absorbed.find(name);
    all.push_back(
        statistics(name, collector[name], at == absorbed.end() ? 0.0 : at->second, solution.state.curve->span().begin));
    const auto told = rig_sigma.find(name);
    if (told != rig_sigma.end()) all.back().rig_sigma = told->second;
  }
  return all;
}

}  // namespace vispline
