#include "vispline/estimate/twin.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/parallel.h"
#include "vispline/core/random.h"
#include "vispline/estimate/parameter_kind.h"

namespace vispline {
namespace {

constexpr double kInterval95 = 1.959963984540054;

/// The measurement as it would have been with other noise: its residuals less those at the estimate, plus noise,
/// weighted as there.
class Redrawn final : public Measurement {
 public:
  Redrawn(const Measurement& measured, const Rows& at_estimate, const RandomStream& noise)
      : measured_(measured), at_estimate_(at_estimate), noise_(noise) {}

  std::vector<std::string> sensors() const override { return measured_.sensors(); }
  Time time() const override { return measured_.time(); }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    measured_.evaluate(state, columns, derivatives, rows);
    rows.cost = 0.5 * static_cast<double>(rows.lost) * kLostSigmas * kLostSigmas;
    for (Eigen::Index i = 0; i < rows.r.size(); ++i) {
      if (at_estimate_.weight(i) == 0.0 || rows.weight(i) == 0.0) {
        rows.weight(i) = 0.0;
        continue;
      }
      const double noise = measured_.only_holds() ? 0.0 : noise_.normal(static_cast<std::uint64_t>(i));
      rows.r(i) += noise - at_estimate_.r(i);
      rows.weight(i) = 1.0;
      rows.cost += 0.5 * rows.r(i) * rows.r(i);
    }
  }

 private:
  const Measurement& measured_;
  const Rows& at_estimate_;
  RandomStream noise_;
};

/// Residuals at the estimate.
struct AtEstimate {
  std::vector<Rows> measurements{};
  std::vector<TrackResiduals> tracks{};

  AtEstimate(const Problem& problem, const Solution& solution) : measurements(problem.measurements.size()) {
    for (std::size_t m = 0; m < measurements.size(); ++m) {
      problem.measurements[m]->evaluate(solution.state, solution.columns, false, measurements[m]);
    }
    for (const Track& track : problem.tracks) {
      tracks.push_back(evaluate_track(solution.state, problem.track_model, track));
    }
  }
};

std::string stream_name(const char* what, std::size_t run, std::size_t index) {
  return std::string(what) + "/" + std::to_string(run) + "/" + std::to_string(index);
}

/// The residual of a pixel is that of the pixel itself, so moving the pixel by as much moves it there.
Track redrawn(const Track& track, const TrackModel& model, const TrackResiduals& at_estimate,
              const RandomStream& noise) {
  Track again = track;
  for (std::size_t i = 0; i < again.sightings.size(); ++i) {
    if (at_estimate.r[i].isZero(0.0)) continue;
    Sighting& s = again.sightings[i];
    const auto z = noise.normal_pair(i);
    s.px += model.sigma_px[s.camera] * (at_estimate.r[i] - Vector2d(z[0], z[1]));
  }
  return again;
}

Problem redrawn(const Problem& problem, const Solution& solution, const AtEstimate& at, std::uint64_t seed,
                std::size_t run) {
  Problem again;
  again.start = solution.state;
  again.parameters = problem.parameters;
  again.track_model = problem.track_model;
  again.track_model.loss = {};
  for (std::size_t m = 0; m < problem.measurements.size(); ++m) {
    again.measurements.push_back(std::make_unique<Redrawn>(*problem.measurements[m], at.measurements[m],
                                                           RandomStream(seed, stream_name("twin", run, m))));
  }
  for (std::size_t t = 0; t < problem.tracks.size(); ++t) {
    again.tracks.push_back(redrawn(problem.tracks[t], problem.track_model, at.tracks[t],
                                   RandomStream(seed, stream_name("twin track", run, t))));
  }
  return again;
}

struct Run {
  bool solved = false;
  Eigen::VectorXd error{};  ///< estimate less truth
  Eigen::VectorXd sigma{};
  double nees = 0.0;
};

Run evaluate(Problem problem, const Solution& truth, int max_iterations) {
  SolveOptions options;
  options.max_iterations = max_iterations;
  const Solution again = solve(problem, options);
  Run run;
  run.solved = again.status == SolveStatus::kConverged && again.full_rank;
  if (!run.solved) return run;
  run.error.resize(again.covariance.rows());
  for (const Parameter& parameter : again.parameters) {
    if (parameter.column < 0) continue;
    run.error.segment(parameter.column - again.columns.layout.first_parameter, parameter.size) =
        -parameter.delta(again.state, truth.state);
  }
  run.sigma = again.covariance.diagonal().cwiseSqrt();
  run.nees = run.error.dot(again.covariance.ldlt().solve(run.error));
  return run;
}

}  // namespace

Twin twin(const Problem& problem, const Solution& solution, const TwinOptions& options) {
  require(solution.covariance.size() > 0 && options.runs >= 2, "a solution with covariance, and two runs or more");
  const AtEstimate at(problem, solution);
  std::vector<Run> runs(static_cast<std::size_t>(options.runs));
  parallel_for(runs.size(), options.threads, [&](std::size_t i) {
    runs[i] = evaluate(redrawn(problem, solution, at, options.seed, i), solution, options.max_iterations);
  });
  Twin result;
  result.runs = options.runs;
  result.states = static_cast<int>(solution.covariance.rows());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(result.states), covered = squares;
  for (const Run& run : runs) {
    if (!run.solved) {
      ++result.failed;
      continue;
    }
    squares += run.error.cwiseAbs2();
    covered.array() += (run.error.array().abs() <= kInterval95 * run.sigma.array()).cast<double>();
    result.nees += run.nees;
  }
  const int solved = result.runs - result.failed;
  if (solved == 0) return result;
  result.nees /= static_cast<double>(solved) * result.states;
  const Band band = nees_band(result.states, solved);
  result.nees_low = band.low;
  result.nees_high = band.high;
  result.coverage = covered.sum() / (static_cast<double>(solved) * result.states);
  const std::vector<NamedComponent> components = named_components(solution.parameters, solution.state);
  for (Eigen::Index i = 0; i < squares.size(); ++i) {
    const NamedComponent& component = components[static_cast<std::size_t>(i)];
    result.components.push_back({component.label(), component.kind.unit, std::sqrt(solution.covariance(i, i)),
                                 std::sqrt(squares(i) / solved), covered(i) / solved});
  }
  return result;
}

}  // namespace vispline
