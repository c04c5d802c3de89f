// Whole solves of one reference problem: CPU seconds, cost, and how far the result is from the truth. Last a baseline
// that does as estimators with automatic differentiation do, and how many times as long it takes.
//   vs_ref_bench [--json]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "cpu_clock.h"
#include "vispline/estimate/solve.h"
#include "vispline/results/json.h"
#include "vispline/results/trajectory_metrics.h"
#include "vs_ref_dual.h"
#include "vs_ref_problem.h"

namespace vispline::bench {
namespace {

constexpr int kRounds = 6;

/// CPU time of this thread, the least of some rounds through all rows: other processes do not count, but they slow
/// whatever runs beside them.
struct Row {
  VsRefSetup setup;
  std::string engine;
  int unknowns = 0, iterations = 0;
  double cpu_s = INFINITY, cost = 0.0, chi2_per_dof = 0.0, ate_mm = 0.0, rotation_mrad = 0.0;
};

void compare(const State& state, const VsRef& data, Row& row) {
  Signal<Pose> estimate, truth;
  for (const Time time : data.imu.time) {
    estimate.push_back(time, state.curve->pose({time}));
    truth.push_back(time, true_pose(seconds(time)));
  }
  TrajectoryCompareOptions options;
  options.deltas.clear();
  const TrajectoryComparison comparison = compare_trajectories(estimate, truth, options);
  row.ate_mm = 1e3 * comparison.position_m.rmse;
  row.rotation_mrad = 1e3 * std::numbers::pi / 180.0 * comparison.rotation_rmse_deg;
}

int scalars(const Problem& problem, const VsRef& data) {
  std::size_t count = 6 * data.imu.size();
  const std::size_t exact = problem.track_model.unknowns == LandmarkUnknowns::kPoint ? 0 : 1;
  for (const Track& track : problem.tracks) count += 2 * (track.sightings.size() - exact);
  return static_cast<int>(count);
}

void run(const VsRef& data, Engine engine, Row& row) {
  Problem problem = vs_ref_problem(data, row.setup);
  SolveOptions options;
  options.engine = engine;
  options.relative_decrease = 1e-6;
  options.covariance = false;
  const double begin = cpu_s();
  const Solution solution = solve(problem, options);
  row.cpu_s = std::min(row.cpu_s, cpu_s() - begin);
  row.iterations = static_cast<int>(solution.iterations.size());
  row.unknowns = solution.columns.layout.columns + static_cast<int>(problem.tracks.size()) * problem.track_model.size();
  row.cost = solution.cost;
  row.chi2_per_dof = 2.0 * row.cost / (scalars(problem, data) - row.unknowns);
  compare(solution.state, data, row);
}

void run_baseline(const VsRef& data, Row& row) {
  const Problem problem = vs_ref_problem(data, row.setup);
  DualBaseline baseline(data, problem.start);
  const double begin = cpu_s();
  const ceres::Solver::Summary summary = baseline.solve();
  row.cpu_s = std::min(row.cpu_s, cpu_s() - begin);
  row.iterations = summary.num_successful_steps + summary.num_unsuccessful_steps - 1;  // it counts the start as one
  row.unknowns = summary.num_effective_parameters;
  row.cost = summary.final_cost;
  row.chi2_per_dof = 2.0 * row.cost / (scalars(problem, data) - row.unknowns);
  State state;
  state.curve = baseline.curve();
  compare(state, data, row);
}

const char* name_of(SplineKind kind) { return kind == SplineKind::kJoint ? "se3" : "split"; }
const char* name_of(LandmarkUnknowns unknowns) {
  return unknowns == LandmarkUnknowns::kPoint ? "point" : "inverse_depth";
}

void print(const Row& row) {
  std::printf(
      "%-12s %-5s %-13s %5.2f s %5d unknowns %2d iterations %7.3f s CPU %6.1f ms each  cost %10.2f  "
      "chi2/dof %.3f  ATE %.3f mm  rotation %.3f mrad\n",
      row.engine.c_str(), name_of(row.setup.kind), name_of(row.setup.unknowns), row.setup.spacing_s, row.unknowns,
      row.iterations, row.cpu_s, 1e3 * row.cpu_s / row.iterations, row.cost, row.chi2_per_dof, row.ate_mm,
      row.rotation_mrad);
  std::fflush(stdout);
}

JsonObject to_json(const Row& row) {
  JsonObject json;
  json.set("engine", row.engine)
      .set("spline", name_of(row.setup.kind))
      .set("landmarks", name_of(row.setup.unknowns))
      .set("knot_spacing_s", row.setup.spacing_s)
      .set("unknowns", row.unknowns)
      .set("iterations", row.iterations)
      .set("cpu_s", row.cpu_s)
      .set("cpu_s_per_iteration", row.cpu_s / row.iterations)
      .set("cost", row.cost)
      .set("chi2_per_dof", row.chi2_per_dof)
      .set("ate_mm", row.ate_mm)
      .set("rotation_mrad", row.rotation_mrad);
  return json;
}

}  // namespace
}  // namespace vispline::bench

int main(int argc, char** argv) {
  using namespace vispline;
  using namespace vispline::bench;
  const bool as_json = argc > 1 && std::strcmp(argv[1], "--json") == 0;
  const VsRef data = VsRefSimulation(10.0).take();
  std::vector<Row> rows;
  for (const char* engine : {"own", "ceres"}) {
    for (const double spacing_s : {0.1, 0.05}) {
      for (const SplineKind kind : {SplineKind::kJoint, SplineKind::kSplit}) {
        for (const LandmarkUnknowns unknowns : {LandmarkUnknowns::kInverseDepth, LandmarkUnknowns::kPoint}) {
          rows.push_back({{kind, spacing_s, unknowns}, engine});
        }
      }
    }
  }
  Row baseline{{SplineKind::kJoint, 0.1, LandmarkUnknowns::kInverseDepth}, "dual numbers"};
  for (int round = 0; round < kRounds; ++round) {
    for (Row& row : rows) run(data, row.engine == "own" ? Engine::kOwn : Engine::kCeres, row);
    if (round == 0 || round + 1 == kRounds) run_baseline(data, baseline);
  }
  rows.push_back(baseline);
  const double ratio = baseline.cpu_s / rows.front().cpu_s;
  if (!as_json) {
    for (const Row& row : rows) print(row);
    std::printf("the baseline takes %.1f times as long as the first row\n", ratio);
    return 0;
  }
  std::vector<JsonObject> documents;
  for (const Row& row : rows) documents.push_back(to_json(row));
  JsonObject document;
  document.set("schema", "vispline.bench_vs_ref/1")
      .set("cpu_s", rows.front().cpu_s)
      .set("iterations", rows.front().iterations)
      .set("baseline_cpu_s", baseline.cpu_s)
      .set("ratio", ratio)
      .set("chi2_per_dof", rows.front().chi2_per_dof)
      .set("ate_mm", rows.front().ate_mm)
      .set("rotation_mrad", rows.front().rotation_mrad)
      .set("rows", documents);
  std::fputs(document.text().c_str(), stdout);
}
