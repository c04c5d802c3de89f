#include "vispline/estimate/jackknife.h"

#include <algorithm>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/parallel.h"
#include "vispline/estimate/parameter_kind.h"

namespace vispline {
namespace {

/// A measurement of another problem, with the weights that it has there.
class Borrowed final : public Measurement {
 public:
  explicit Borrowed(const Measurement& measurement) : measurement_(measurement) {}
  std::vector<std::string> sensors() const override { return measurement_.sensors(); }
  std::size_t sensor_of(Eigen::Index row) const override { return measurement_.sensor_of(row); }
  Time time() const override { return measurement_.time(); }
  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    measurement_.evaluate(state, columns, derivatives, rows);
  }

 private:
  const Measurement& measurement_;
};

/// Of an instrument, not a prior.
bool is_reading(const Measurement& measurement) {
  for (std::size_t s = 0; s < measurement.sensors().size(); ++s) {
    if (measurement.scale_of(s).sigma > 0.0) return true;
  }
  return false;
}

/// What is left of a track outside `block`; empty without its reference view, or with nothing beside it.
std::vector<Sighting> outside(const Track& track, const TimeSpan& block) {
  std::vector<Sighting> left;
  for (const Sighting& s : track.sightings) {
    const bool inside = s.stamp >= block.begin && s.stamp < block.end;
    if (!inside) left.push_back(s);
    if (inside && left.empty()) return {};
  }
  if (left.size() < 2) left.clear();
  return left;
}

Problem without(const Problem& problem, const Solution& solution, const TimeSpan& block) {
  Problem rest;
  rest.start = solution.state;
  rest.parameters = problem.parameters;
  rest.track_model = problem.track_model;
  for (const auto& measurement : problem.measurements) {
    const bool inside = measurement->time() >= block.begin && measurement->time() < block.end;
    if (inside && is_reading(*measurement)) continue;
    rest.measurements.push_back(std::make_unique<Borrowed>(*measurement));
  }
  for (const Track& track : problem.tracks) {
    std::vector<Sighting> left = outside(track, block);
    if (!left.empty()) rest.tracks.push_back({track.landmark, std::move(left)});
  }
  return rest;
}

/// First and last reading.
TimeSpan measured_span(const Problem& problem) {
  TimeSpan span{problem.start.curve->span().end, problem.start.curve->span().begin};
  const auto extend = [&](Time time) {
    span.begin = std::min(span.begin, time);
    span.end = std::max(span.end, time);
  };
  for (const auto& measurement : problem.measurements) {
    if (is_reading(*measurement)) extend(measurement->time());
  }
  for (const Track& track : problem.tracks) {
    for (const Sighting& s : track.sightings) extend(s.stamp);
  }
  span.end += Duration(1);
  return span;
}

Eigen::VectorXd difference(const Solution& from, const State& to) {
  Eigen::VectorXd delta(from.covariance.rows());
  for (const Parameter& parameter : from.parameters) {
    if (parameter.column < 0) continue;
    delta.segment(parameter.column - from.columns.layout.first_parameter, parameter.size) =
        parameter.delta(from.state, to);
  }
  return delta;
}

}  // namespace

Jackknife jackknife(const Problem& problem, const Solution& solution, const JackknifeOptions& options) {
  require(solution.covariance.size() > 0 && options.blocks >= 2, "a solution with covariance, and two blocks or more");
  const TimeSpan span = measured_span(problem);
  const auto blocks = static_cast<std::size_t>(options.blocks);
  std::vector<std::optional<Eigen::VectorXd>> moved(blocks);
  parallel_for(blocks, options.threads, [&](std::size_t b) {
    const Duration all = span.end - span.begin;
    const auto edge = [&](std::size_t i) {
      return span.begin + Duration(all.count() / options.blocks * static_cast<std::int64_t>(i));
    };
    Problem rest = without(problem, solution, {edge(b), b + 1 == blocks ? span.end : edge(b + 1)});
    SolveOptions solve_options;
    solve_options.max_iterations = options.max_iterations;
    solve_options.covariance = false;
    const Solution again = solve(rest, solve_options);
    if (again.status == SolveStatus::kConverged) moved[b] = difference(solution, again.state);
  });
  Jackknife result;
  result.blocks = options.blocks;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(solution.covariance.rows()), squares = sum;
  double count = 0.0;
  for (const auto& m : moved) {
    if (!m) {
      ++result.failed;
      continue;
    }
    sum += *m;
    squares += m->cwiseAbs2();
    count += 1.0;
  }
  if (count < 2.0) return result;
  const Eigen::VectorXd variance = (count - 1.0) / count * (squares - sum.cwiseAbs2() / count);
  const std::vector<NamedComponent> components = named_components(solution.parameters, solution.state);
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    const NamedComponent& component = components[static_cast<std::size_t>(i)];
    result.components.push_back({component.label(), component.kind.unit, std::sqrt(solution.covariance(i, i)),
                                 std::sqrt(std::max(0.0, variance(i))), 0.0});
  }
  return result;
}

}  // namespace vispline
