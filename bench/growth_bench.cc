// How the cost of an estimation grows with time: the motion of the reference problem for 10 to 300 s, an IMU and a
// rolling-shutter camera before a known target, a start that is off. Prints CPU seconds and the exponent of the growth.
//   growth_bench [--json]
#include <cmath>
#include <cstdio>
#include <cstring>

#include "cpu_clock.h"
#include "vispline/estimate/solve.h"
#include "vispline/estimate/target_measurement.h"
#include "vispline/results/json.h"
#include "vs_ref_problem.h"

namespace vispline::bench {
namespace {

/// The tracks of the reference problem as images of points that are known.
void know_points(const VsRef& data, Problem& problem) {
  std::map<Time, TargetFrame> frames;
  for (const Track& track : data.tracks) {
    for (const Sighting& s : track.sightings) {
      TargetFrame& frame = frames[s.stamp];
      frame.stamp = s.stamp;
      frame.sigma_px = kPixelSigma;
      frame.px.push_back(s.px);
      frame.point.push_back(data.points_w[data.point_of_track[track.landmark]]);
    }
  }
  for (auto& [stamp, frame] : frames) problem.measurements.push_back(target_measurement(problem.start, frame));
  problem.tracks.clear();
  problem.start.landmarks.clear();
}

struct Row {
  double duration_s, cpu_s;
  int columns, iterations;
  double cost;
};

Row run(double duration_s) {
  const VsRef data = VsRefSimulation(duration_s).take();
  Problem problem = vs_ref_problem(data, {});
  know_points(data, problem);
  SolveOptions options;
  options.covariance = false;
  const double begin = cpu_s();
  const Solution solution = solve(problem, options);
  return {duration_s, cpu_s() - begin, solution.columns.layout.columns, static_cast<int>(solution.iterations.size()),
          solution.cost};
}

/// Slope of log CPU over log duration, least squares.
double exponent(const std::vector<Row>& rows) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const Row& row : rows) {
    const double a = std::log(row.duration_s), b = std::log(row.cpu_s / row.iterations);
    n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

}  // namespace
}  // namespace vispline::bench

int main(int argc, char** argv) {
  using namespace vispline;
  using namespace vispline::bench;
  const bool as_json = argc > 1 && std::strcmp(argv[1], "--json") == 0;
  std::vector<Row> rows;
  std::vector<JsonObject> documents;
  for (const double duration_s : {10.0, 30.0, 100.0, 300.0}) {
    const Row& row = rows.emplace_back(run(duration_s));
    if (!as_json) {
      std::printf("%5.0f s  %6d columns  %2d iterations  %8.3f s CPU  %8.2f ms an iteration  cost %.1f\n",
                  row.duration_s, row.columns, row.iterations, row.cpu_s, 1e3 * row.cpu_s / row.iterations, row.cost);
      std::fflush(stdout);
    }
    documents.push_back(JsonObject()
                            .set("duration_s", row.duration_s)
                            .set("columns", row.columns)
                            .set("iterations", row.iterations)
                            .set("cpu_s", row.cpu_s)
                            .set("cost", row.cost));
  }
  if (!as_json) std::printf("CPU of an iteration grows as duration^%.3f\n", exponent(rows));
  JsonObject document;
  document.set("schema", "vispline.bench_growth/1").set("exponent", exponent(rows)).set("rows", documents);
  if (as_json) std::fputs(document.text().c_str(), stdout);
}
