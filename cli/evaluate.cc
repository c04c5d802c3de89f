// vispline evaluate FIRST SECOND: two trajectories, or two IMU recordings of the same motion.
#include <iostream>
#include <memory>

#include "flags.h"
#include "validators.h"
#include "verbs.h"
#include "vispline/results/documents.h"
#include "vispline/results/evo_result.h"

namespace vispline::cli {
namespace {

struct EvaluateFlags {
  Session session;
  ReadFlags read;
  std::string first, second, as, align = "se3", evo;
  ImuCompareOptions imu;
};

/// What both files can be compared as.
std::string kind_of(const EvaluateFlags& flags) {
  if (!flags.as.empty()) return flags.as;
  const ContentKind a = content_of(flags.first, flags.read.options(0, flags.session));
  const ContentKind b = content_of(flags.second, flags.read.options(1, flags.session));
  const auto fits = [&](ContentKind kind) {
    return (a == kind || a == ContentKind::kBoth) && (b == kind || b == ContentKind::kBoth);
  };
  const bool imu = fits(ContentKind::kImu), trajectory = fits(ContentKind::kTrajectory);
  if (imu != trajectory) return imu ? "imu" : "trajectory";
  throw Error(ExitCode::kUsage,
              {.code = "E-KIND",
               .message = imu ? "both files hold IMU samples and poses" : "one file holds IMU samples, the other poses",
               .where = flags.first + ", " + flags.second,
               .effect = "nothing compared",
               .next = imu ? "pass --as imu or --as trajectory" : "give two files of the same kind"});
}

void evaluate_imu(EvaluateFlags& flags) {
  auto first = read_imu(flags.first, flags.read.options(0, flags.session));
  auto second = read_imu(flags.second, flags.read.options(1, flags.session));
  flags.session.add_input("first", first.counts, first.diagnostics);
  flags.session.add_input("second", second.counts, second.diagnostics);
  const ImuComparison comparison = compare_imu(first.value, second.value, flags.imu);
  flags.session.finish(comparison.diagnostics);
  std::cout << (flags.session.json ? evaluate_imu_json(comparison, flags.session.context)
                                   : evaluate_imu_text(comparison));
}

void evaluate_trajectory(EvaluateFlags& flags) {
  auto estimate = read_trajectory(flags.first, flags.read.options(0, flags.session));
  auto reference = read_trajectory(flags.second, flags.read.options(1, flags.session));
  flags.session.add_input("estimate", estimate.counts, estimate.diagnostics);
  flags.session.add_input("reference", reference.counts, reference.diagnostics);
  TrajectoryCompareOptions options;
  options.alignment = *alignment_from_name(flags.align);
  const TrajectoryComparison comparison = compare_trajectories(estimate.value, reference.value, options);
  flags.session.finish(comparison.diagnostics);
  if (!flags.evo.empty()) {
    const OutputGuard guard;
    write_file(flags.evo, evo_result_zip(comparison, flags.second, flags.first), output_options(flags.session));
  }
  std::cout << (flags.session.json ? evaluate_trajectory_json(comparison, flags.session.context)
                                   : evaluate_trajectory_text(comparison));
}

}  // namespace

void add_evaluate(CLI::App& app) {
  auto flags = std::make_shared<EvaluateFlags>();
  CLI::App* verb = app.add_subcommand("evaluate", "compare an estimate with a reference, or two IMU recordings");
  verb->add_option("first", flags->first, "estimate, or the IMU whose stamps are moved")->required();
  verb->add_option("second", flags->second, "reference, or the IMU it is compared at")->required();
  verb->add_option("--as", flags->as, "what to compare, found from the files otherwise")
      ->check(CLI::IsMember({"imu", "trajectory"}));
  verb->add_option("--align", flags->align, "alignment of the estimate with the reference")
      ->check(CLI::IsMember({"none", "se3", "sim3", "yaw"}))
      ->capture_default_str();
  verb->add_option("--evo", flags->evo,
                   "write the absolute position errors of two trajectories as a result of evo (zip)")
      ->check(not_empty());
  verb->add_option("--max-offset", flags->imu.max_offset_s, "largest time offset of two IMUs to look for [s]")
      ->check(positive());
  flags->read.add_to(*verb);
  add_session_flags(*verb, flags->session);
  verb->callback([flags] { kind_of(*flags) == "imu" ? evaluate_imu(*flags) : evaluate_trajectory(*flags); });
}

}  // namespace vispline::cli
