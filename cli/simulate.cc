// vispline simulate: a motion and an instrument in, a recording out.
#include <iostream>
#include <memory>

#include "flags.h"
#include "rig_flags.h"
#include "simulate_output.h"
#include "simulate_rig.h"
#include "validators.h"
#include "verbs.h"
#include "vispline/results/table.h"

namespace vispline::cli {
namespace {

struct SimulateFlags {
  Session session;
  ReadFlags read;
  TrajectoryFlags trajectory;
  ImuFlags imu;
  RigFlags rig;
  double rate_hz = 200.0;
  std::size_t imus = 1;
  std::string like, format = "auto", out, truth;
};

std::string chosen_format(const SimulateFlags& flags) {
  if (flags.format != "auto") return flags.format;
  return flags.out.find(".csv") != std::string::npos ? "csv" : "euroc";
}

/// The stamps of a recorded IMU at which the motion is known.
std::vector<Time> known_stamps(const ImuSignal& like, const TrajectorySource& source, SimulateFlags& flags) {
  std::vector<Time> stamps;
  std::int64_t outside = 0, in_gaps = 0;
  for (const Time stamp : like.time) {
    const Time t = stamp + from_seconds(flags.imu.time_offset_s);
    if (!source.trajectory.span().contains(t)) {
      ++outside;
    } else if (source.fit && source.fit->in_gap(t)) {
      ++in_gaps;
    } else {
      stamps.push_back(stamp);
    }
  }
  const auto warn = [&](std::int64_t count, const char* code, const std::string& why) {
    if (count == 0) return;
    flags.session.add({.code = code,
                       .message = std::to_string(count) + " of " + std::to_string(like.size()) + " stamps " + why,
                       .where = flags.like,
                       .effect = "no sample is simulated there",
                       .next = ""});
  };
  warn(outside, "W-SPAN", "lie outside the trajectory");
  warn(in_gaps, "W-GAP", "lie in gaps of the poses, where the motion is not known");
  return stamps;
}

Stamps stamps_of(const TrajectorySource& source, SimulateFlags& flags) {
  if (!flags.like.empty()) {
    auto like = read_imu(flags.like, flags.read.options(1, flags.session));
    flags.session.add_input("like", like.counts, like.diagnostics);
    return Stamps(known_stamps(like.value, source, flags));
  }
  const TimeSpan span = source.trajectory.span();
  const Time start = flags.trajectory.start_s ? Time{} + from_seconds(*flags.trajectory.start_s) : span.begin;
  const Duration duration =
      flags.trajectory.duration_s ? from_seconds(*flags.trajectory.duration_s) : Duration(span.end - start);
  return Stamps({start, flags.rate_hz}, duration);
}

void print_summary(const SimulateFlags& flags, const TrajectorySource& source, const Stamps& stamps,
                   const std::string& format) {
  if (flags.session.json) {
    JsonObject document = begin_document("vispline.simulate/1", flags.session.context);
    document.set("format", format)
        .set("imus", static_cast<std::int64_t>(flags.imus))
        .set("samples", static_cast<std::int64_t>(stamps.size()))
        .set("begin_s", to_seconds(stamps[0] - Time{}))
        .set("end_s", to_seconds(stamps[stamps.size() - 1] - Time{}))
        .set("seed", static_cast<std::int64_t>(flags.imu.seed));
    if (source.fit) document.set("fit", fit_json(*source.fit));
    end_document(document, flags.session.context);
    std::cout << document.text();
    return;
  }
  if (source.fit) std::cout << fit_text(*source.fit);
  std::cout << stamps.size() << " samples over " << number_text(to_seconds(stamps[stamps.size() - 1] - stamps[0]), 9)
            << " s written to " << flags.out << " (" << format << ")\n";
}

void run(SimulateFlags& flags) {
  const std::string format = chosen_format(flags);
  require(format == "euroc" || flags.imus == 1, "--format euroc for more than one IMU");
  require(format == "csv" || flags.truth.empty(), "--format csv with --truth; the others write the truth anyway");
  probe_simulation({flags.out, flags.truth, format, flags.imus}, output_options(flags.session));
  const TrajectorySource source = load_trajectory(flags.trajectory, flags.read, flags.session);
  const Stamps stamps = stamps_of(source, flags);
  std::vector<ImuSimulation> imus;
  for (std::size_t i = 0; i < flags.imus; ++i) {
    imus.push_back(flags.imu.simulation("imu" + std::to_string(i), flags.rate_hz));
  }
  flags.session.finish();
  const SimulationTask task{source.trajectory, imus, stamps, flags.out, flags.truth, output_options(flags.session)};
  write_simulation(task, format);
  print_summary(flags, source, stamps, format);
}

}  // namespace

void add_simulate(CLI::App& app) {
  auto flags = std::make_shared<SimulateFlags>();
  CLI::App* verb =
      app.add_subcommand("simulate", "recordings of an IMU or a whole rig, from a formula or from any file of poses");
  flags->trajectory.add_to(*verb);
  CLI::Option* rate =
      verb->add_option("--imu-rate", flags->rate_hz, "[Hz]")->check(positive(kMaxRate_hz))->capture_default_str();
  verb->add_option("--like", flags->like, "simulate at the stamps of this IMU file")->excludes(rate);
  verb->add_option("--imus", flags->imus, "number of IMUs at one place, with noise of their own")
      ->check(between(1, 1000))
      ->capture_default_str();
  verb->add_option("--format", flags->format, "csv: one file; euroc: folder mav0 with ground truth; course: text files")
      ->check(CLI::IsMember({"auto", "csv", "euroc", "course"}))
      ->capture_default_str();
  verb->add_option("--out", flags->out, "file (csv) or folder to write")->required()->check(not_empty());
  verb->add_option("--truth", flags->truth, "with csv: also write poses, velocities and biases (EuRoC ground truth)")
      ->check(not_empty());
  flags->imu.add_to(*verb);
  flags->read.add_to(*verb);
  add_session_flags(*verb, flags->session);
  flags->rig.add_to(*verb);
  verb->callback([flags, verb] {
    if (!flags->rig.is_given()) return run(*flags);
    refuse_imu_flags(*verb);
    simulate_rig({flags->rig, flags->read, flags->trajectory, flags->imu.seed, flags->imu.threads, flags->out},
                 flags->session);
  });
}

}  // namespace vispline::cli
