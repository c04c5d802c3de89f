#include "vispline/estimate/jackknife.h"

#include <algorithm>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/estimate/normal_equations.h"
#include "vispline/estimate/parameter_kind.h"
#include "vispline/estimate/track_columns.h"
#include "vispline/estimate/view_sums.h"

namespace vispline {
namespace {

/// Of an instrument, not a prior.
bool is_reading(const Measurement& measurement) {
  for (std::size_t s = 0; s < measurement.sensors().size(); ++s) {
    if (measurement.scale_of(s).sigma > 0.0) return true;
  }
  return false;
}

/// Equal parts of the time between the first reading and the last.
class Blocks {
 public:
  Blocks(const Problem& problem, int count) : count_(count) {
    for (const auto& measurement : problem.measurements) {
      if (is_reading(*measurement)) extend(measurement->time());
    }
    for (const Track& track : problem.tracks) extend(track.sightings.front().stamp);
  }
  Eigen::Index of(Time time) const {
    const double share = to_seconds(time - begin_) / std::max(1e-9, to_seconds(end_ - begin_));
    return std::clamp(static_cast<Eigen::Index>(share * count_), Eigen::Index{0}, Eigen::Index{count_ - 1});
  }

 private:
  void extend(Time time) {
    begin_ = any_ ? std::min(begin_, time) : time;
    end_ = any_ ? std::max(end_, time) : time;
    any_ = true;
  }
  int count_;
  bool any_ = false;
  Time begin_{}, end_{};
};

/// J^T r of the readings of each block; a track counts where its landmark is anchored.
Eigen::MatrixXd scores(const Problem& problem, const Solution& solution, const Blocks& blocks, int count) {
  Eigen::MatrixXd score = Eigen::MatrixXd::Zero(solution.columns.layout.columns, count);
  const auto add = [&](const std::vector<int>& column, const Eigen::VectorXd& g, Time time) {
    score(column, blocks.of(time)) += g;
  };
  Rows rows;
  for (const auto& measurement : problem.measurements) {
    if (!is_reading(*measurement)) continue;
    measurement->evaluate(solution.state, solution.columns, true, rows);
    add(rows.column, rows.pull(rows.weight.cwiseProduct(rows.r)), measurement->time());
  }
  ViewSums unused(solution.state, solution.columns);
  for (const Track& track : problem.tracks) {
    const TrackColumns local(solution.state, solution.columns, track);
    const TrackBlock equations =
        linearize_track(solution.state, solution.columns, local, problem.track_model, track, Weights::kKept, unused);
    add(equations.column, equations.g, track.sightings.front().stamp);
  }
  return score;
}

}  // namespace

Jackknife jackknife(const Problem& problem, const Solution& solution, const JackknifeOptions& options) {
  require(solution.equations && solution.covariance.size() > 0 && options.blocks >= 2,
          "a solution with covariance, and two blocks or more");
  Jackknife result;
  result.blocks = options.blocks;
  const auto pulled =
      solution.equations->solve(scores(problem, solution, Blocks(problem, options.blocks), options.blocks));
  if (!pulled) return result;
  const Eigen::MatrixXd shift = pulled->bottomRows(solution.covariance.rows());
  const double g = options.blocks;
  const Eigen::VectorXd mean = shift.rowwise().mean();
  const Eigen::VectorXd variance = g / (g - 1.0) * (shift.colwise() - mean).rowwise().squaredNorm();
  const std::vector<NamedComponent> components = named_components(solution.parameters, solution.state);
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    const NamedComponent& component = components[static_cast<std::size_t>(i)];
    result.components.push_back(
        {component.label(), component.kind.unit, std::sqrt(solution.covariance(i, i)), std::sqrt(variance(i)), 0.0});
  }
  return result;
}

}  // namespace vispline
