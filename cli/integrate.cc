// vispline integrate: what each integration rule costs, beside the truth.
#include <algorithm>
#include <iostream>
#include <memory>

#include "flags.h"
#include "integration_table.h"
#include "validators.h"
#include "verbs.h"
#include "vispline/integrate/dead_reckon.h"
#include "vispline/integrate/rules.h"
#include "vispline/io/write.h"
#include "vispline/results/documents.h"

namespace vispline::cli {
namespace {

struct IntegrateFlags {
  Session session;
  ReadFlags read;
  TrajectoryFlags trajectory;
  ImuFlags imu;
  std::vector<double> rates_hz{200.0};
  std::vector<std::string> methods{"all"};
  std::string measured, out;
};

std::vector<std::string> chosen_methods(const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), "all") != names.end()) return rule_names();
  for (const std::string& name : names) integration_rule(name);
  return names;
}

/// The part of a measured IMU signal where the truth is known.
ImuSignal inside(const ImuSignal& imu, const Trajectory& truth) {
  ImuSignal kept;
  for (std::size_t i = 0; i < imu.size(); ++i) {
    if (truth.span().contains(imu.time[i])) kept.push_back(imu.time[i], imu.value[i]);
  }
  return kept;
}

/// Dead reckoning of a recorded IMU from the true state at its first sample.
std::vector<IntegrationRow> measured_table(IntegrateFlags& flags, const Trajectory& truth,
                                           const std::vector<std::string>& methods) {
  auto read = read_imu(flags.measured, flags.read.options(1, flags.session));
  flags.session.add_input("imu", read.counts, read.diagnostics);
  const ImuSignal imu = inside(read.value, truth);
  if (imu.size() < 2) {
    throw Error(ExitCode::kUnfit, {.code = "E-OVERLAP",
                                   .message = std::to_string(imu.size()) + " IMU samples within the trajectory",
                                   .where = flags.measured + ", " + flags.trajectory.source,
                                   .effect = "nothing integrated",
                                   .next = "check that both files use one clock"});
  }
  const double rate_hz = static_cast<double>(imu.size() - 1) / imu.span().seconds();
  const Vector3d g_w(0.0, 0.0, -flags.imu.gravity);
  std::vector<IntegrationRow> rows;
  for (const std::string& method : methods) {
    const auto states = dead_reckon(imu, nav_state(*truth.at(imu.time.front())), method, g_w);
    rows.push_back({method, rate_hz, dead_reckoning_error(poses(states), truth), std::nullopt});
  }
  return rows;
}

void check_output(const IntegrateFlags& flags, const std::vector<std::string>& methods) {
  if (flags.out.empty()) return;
  require(methods.size() == 1 && flags.rates_hz.size() == 1 && flags.measured.empty(),
          "one --method and one --imu-rate with --out");
  probe_output(flags.out, 0, output_options(flags.session));
}

void write_trajectory(const IntegrateFlags& flags, const Trajectory& truth, const std::vector<std::string>& methods) {
  if (flags.out.empty()) return;
  const ImuSimulation simulation = flags.imu.simulation("imu0", flags.rates_hz[0]);
  const SimulatedImu samples = simulate_whole(truth, simulation, flags.rates_hz[0]);
  const Signal<Pose> estimate = integrated(samples, methods[0], simulation.g_w);
  const OutputGuard guard;
  write_trajectory_tum(flags.out, estimate, output_options(flags.session));
}

void run(IntegrateFlags& flags) {
  const std::vector<std::string> methods = chosen_methods(flags.methods);
  check_output(flags, methods);
  const TrajectorySource source = load_trajectory(flags.trajectory, flags.read, flags.session);
  const auto rows = flags.measured.empty()
                        ? integration_table(source.trajectory, flags.imu.simulation("imu0", flags.rates_hz[0]),
                                            flags.rates_hz, methods)
                        : measured_table(flags, source.trajectory, methods);
  flags.session.finish();
  write_trajectory(flags, source.trajectory, methods);
  std::cout << (flags.session.json ? integrate_json(rows, flags.session.context) : integrate_text(rows));
}

}  // namespace

void add_integrate(CLI::App& app) {
  auto flags = std::make_shared<IntegrateFlags>();
  CLI::App* verb = app.add_subcommand("integrate", "dead reckoning by every rule, side by side with the truth");
  flags->trajectory.add_to(*verb);
  verb->add_option("--imu-rate", flags->rates_hz, "[Hz], several separated by commas")
      ->delimiter(',')
      ->check(positive(kMaxRate_hz));
  verb->add_option("--method", flags->methods, "names separated by commas, or all")->delimiter(',');
  verb->add_option("--imu", flags->measured, "a recorded IMU instead of a simulated one; --trajectory is its truth");
  verb->add_option("--out", flags->out, "write the integrated trajectory of one method (TUM)")->check(not_empty());
  flags->imu.add_to(*verb);
  flags->read.add_to(*verb);
  add_session_flags(*verb, flags->session);
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli
