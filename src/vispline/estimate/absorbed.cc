#include "vispline/estimate/absorbed.h"

#include "vispline/estimate/noise_estimation.h"

namespace vispline {
namespace {

constexpr int kProbes = 8;

void share_among_tracks(const Problem& problem, const Solution& solution, double rest,
                        std::map<std::string, double>& absorbed) {
  std::map<std::string, double> count;
  double all = 0.0;
  for (const Track& track : problem.tracks) {
    for (const Sighting& s : track.sightings) count[solution.state.rig.cameras[s.camera].name] += 1.0;
    all += static_cast<double>(track.sightings.size());
  }
  for (const auto& [camera, sightings] : count) absorbed[camera] += rest * sightings / all;
}

}  // namespace

std::map<std::string, double> absorbed_by_sensor(const Problem& problem, const Solution& solution,
                                                 const NormalEquations& equations, std::size_t threads) {
  std::map<std::string, double> absorbed;
  double rest =
      solution.columns.layout.columns + static_cast<double>(problem.tracks.size()) * problem.track_model.size();
  for (const auto& [sensor, fit] :
       sensor_fits(problem, solution.state, solution.columns, equations, threads, kProbes)) {
    absorbed[sensor] = static_cast<double>(fit.rows) - fit.redundancy;
    rest -= absorbed[sensor];
  }
  if (!absorbed.empty() || problem.measurements.empty()) share_among_tracks(problem, solution, rest, absorbed);
  return absorbed;
}

}  // namespace vispline
