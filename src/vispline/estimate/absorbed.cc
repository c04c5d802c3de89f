#include "vispline/estimate/absorbed.h"

#include <cmath>

#include "vispline/core/random.h"

namespace vispline {
namespace {

constexpr int kProbes = 8;
constexpr std::uint64_t kSeed = 1;

double sign(const RandomStream& stream, std::uint64_t index) {
  return stream.uniform_pair(index / 2)[index % 2] > 0.5 ? 1.0 : -1.0;
}

/// J_s^T z of every sensor and probe.
std::map<std::string, Eigen::MatrixXd> pushes(const Problem& problem, const Solution& solution) {
  std::map<std::string, Eigen::MatrixXd> push;
  const RandomStream stream(kSeed, "hutchinson");
  std::uint64_t index = 0;
  Rows rows;
  for (const auto& measurement : problem.measurements) {
    measurement->evaluate(solution.state, solution.columns, true, rows);
    const std::vector<std::string> sensors = measurement->sensors();
    for (Eigen::Index row = 0; row < rows.r.size(); ++row) {
      Eigen::MatrixXd& sum = push[sensors[measurement->sensor_of(row)]];
      if (sum.size() == 0) sum.setZero(solution.columns.layout.columns, kProbes);
      Eigen::RowVectorXd z(kProbes);
      for (int p = 0; p < kProbes; ++p) z(p) = std::sqrt(rows.weight(row)) * sign(stream, index++);
      for (std::size_t c = 0; c < rows.column.size(); ++c) {
        const double J = rows.J(row, static_cast<Eigen::Index>(c));
        if (J != 0.0) sum.row(rows.column[c]) += J * z;
      }
    }
  }
  return push;
}

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
                                                 const NormalEquations& equations) {
  std::map<std::string, double> absorbed;
  double rest =
      solution.columns.layout.columns + static_cast<double>(problem.tracks.size()) * problem.track_model.size();
  for (const auto& [sensor, push] : pushes(problem, solution)) {
    const std::vector<Step> steps = equations.respond(push);
    if (steps.empty()) return {};
    double trace = 0.0;
    for (int p = 0; p < kProbes; ++p) trace += push.col(p).dot(steps[static_cast<std::size_t>(p)].delta) / kProbes;
    absorbed[sensor] = trace;
    rest -= trace;
  }
  share_among_tracks(problem, solution, rest, absorbed);
  return absorbed;
}

}  // namespace vispline
