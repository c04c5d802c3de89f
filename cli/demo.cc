// vispline demo: the whole loop on a known motion, with a report.
#include <iostream>
#include <memory>

#include "demo_loop.h"
#include "demo_page.h"
#include "flags.h"
#include "integration_table.h"
#include "validators.h"
#include "verbs.h"
#include "vispline/core/parallel.h"
#include "vispline/integrate/rules.h"
#include "vispline/io/write.h"
#include "vispline/results/calibration_documents.h"
#include "vispline/results/documents.h"
#include "vispline/trajectory/analytic.h"

namespace vispline::cli {
namespace {

constexpr double kDuration_s = 20.0, kRate_hz = 200.0;
const std::vector<double> kRates_hz{50.0, 100.0, 200.0, 400.0, 1000.0};
const std::vector<std::string> kCurves{"euler_course", "midpoint_course_report", "midpoint", "rk4_cubic"};

struct DemoFlags {
  Session session;
  std::string out = "out/demo";
  std::uint64_t seed = 1;
};

std::vector<ErrorCurve> error_curves(const SimulatedImu& samples, const Vector3d& g_w) {
  std::vector<ErrorCurve> curves;
  for (const std::string& method : kCurves) {
    const Signal<Pose> estimate = integrated(samples, method, g_w);
    ErrorCurve curve{method, {}, {}};
    for (std::size_t i = 1; i < estimate.size(); ++i) {
      curve.time_s.push_back(to_seconds(estimate.time[i] - estimate.time.front()));
      curve.error_m.push_back((estimate.value[i].p - samples.body.value[i].p_w).norm());
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

DemoResult simulate_demo(std::uint64_t seed) {
  const Trajectory trajectory = *analytic_trajectory("ellipse", Time{}, from_seconds(kDuration_s));
  ImuFlags imu;
  imu.seed = seed;
  const ImuSimulation exact = imu.simulation("imu0", kRate_hz);
  imu.noise = "course";
  DemoResult demo{.trajectory = "ellipse", .simulation = imu.simulation("imu0", kRate_hz)};
  demo.samples = simulate_whole(trajectory, demo.simulation, kRate_hz);
  demo.exact_rows = integration_table(trajectory, exact, kRates_hz, rule_names());
  demo.exact = error_curves(simulate_whole(trajectory, exact, kRate_hz), exact.g_w);
  demo.noisy = error_curves(demo.samples, exact.g_w);
  return demo;
}

void run(DemoFlags& flags) {
  const OutputOptions output{.force = true};
  const std::string report_path = flags.out + "/report.html";
  probe_output(report_path, 0, output);
  const DemoResult demo = simulate_demo(flags.seed);
  const DemoLoop loop = run_loop(flags.seed, hardware_threads());
  write_imu_csv(flags.out + "/imu.csv", demo.samples.measured, output);
  Signal<Pose> truth{demo.samples.body.time, {}};
  for (const BodyState& state : demo.samples.body.value) truth.value.push_back(state.T_w_b());
  write_trajectory_tum(flags.out + "/truth.tum", truth, output);
  write_file(flags.out + "/result.json", calibration_json(loop.calibration, flags.session.context), output);
  write_file(flags.out + "/integration.json", integrate_json(demo.exact_rows, flags.session.context), output);
  const report::Provenance provenance{
      .version = VISPLINE_VERSION, .seed = flags.seed, .command = "vispline demo --seed " + std::to_string(flags.seed)};
  write_file(report_path, report::render(demo_page(demo, loop, provenance)), output);
  if (flags.session.json) {
    std::cout << integrate_json(demo.exact_rows, flags.session.context);
    return;
  }
  std::vector<IntegrationRow> rows;
  for (const IntegrationRow& row : demo.exact_rows) {
    if (row.rate_hz == kRate_hz) rows.push_back(row);
  }
  std::cout
      << "A phone was simulated, its noise identified from " << loop.still_s / 60.0
      << " min at rest, and its rig calibrated from\na start that is 5 deg, 5 cm, 20 ms and 2 % off; truth beside "
         "every number.\n\n"
      << calibration_text(loop.calibration) << "\nDead reckoning, ellipse, 20 s at 200 Hz, noise-free:\n\n"
      << integrate_text(rows) << "\nReport: " << report_path
      << "\nData:   result.json, imu.csv (with noise), truth.tum and integration.json beside it\n";
}

}  // namespace

void add_demo(CLI::App& app) {
  auto flags = std::make_shared<DemoFlags>();
  CLI::App* verb = app.add_subcommand(
      "demo", "the whole loop on made-up data: simulate, identify, integrate, calibrate, with a report");
  verb->add_option("--out", flags->out, "folder to write; its demo files are replaced")
      ->check(not_empty())
      ->capture_default_str();
  verb->add_option("--seed", flags->seed, "of the noise")->check(not_negative(kMaxSeed))->capture_default_str();
  verb->add_flag("--json", flags->session.json, "write the table as JSON to stdout");
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli
