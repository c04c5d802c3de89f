// vispline allan: the noise of a still IMU, each number with its interval and its unit.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "allan_output.h"
#include "allan_self_test.h"
#include "allan_source.h"
#include "flags.h"
#include "validators.h"
#include "verbs.h"
#include "vispline/bags/open_bag.h"
#include "vispline/calibration/imu_utils_explanation.h"
#include "vispline/core/parallel.h"
#include "vispline/results/allan_documents.h"

namespace vispline::cli {
namespace {

constexpr double kDefaultDuration_s = 14400.0;

struct AllanFlags {
  Session session;
  ReadFlags read;
  ImuFlags imu;
  std::string file, data = "imu", out, explain, memory = "auto";
  std::string taus = "log";
  std::vector<std::string> deviations{"oadev"}, dialects;
  bool self_test = false;
  int runs = 24;
  std::optional<double> duration_s;
};

AllanOptions analysis_options(const AllanFlags& flags) {
  AllanOptions options;
  options.deviations.clear();
  for (const std::string& name : flags.deviations) {
    const auto kind = deviation_named(name);
    std::string known;
    for (const std::string& each : deviation_names()) known += (known.empty() ? "" : ", ") + each;
    require(kind.has_value(), "--deviation of " + known);
    options.deviations.push_back(*kind);
  }
  options.taus = flags.taus;
  options.memory = flags.memory == "exact"     ? AllanMemory::kExact
                   : flags.memory == "bounded" ? AllanMemory::kBounded
                                               : AllanMemory::kAuto;
  options.threads = flags.imu.threads == 0 ? hardware_threads() : flags.imu.threads;
  options.clock = flags.data != "imu";
  return options;
}

/// A single table has no topics: there --topic only names the sensor in the parameter files.
void drop_topic_of_table(ReadOptions& read, const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) && !is_bag(path)) read.topic.clear();
}

AllanResult analyze(AllanFlags& flags) {
  const AllanOptions options = analysis_options(flags);
  ReadOptions read = flags.read.options(0, flags.session);
  drop_topic_of_table(read, flags.file);
  if (flags.data == "imu") return analyze_imu(flags.file, read, options, flags.session);
  const double rate_hz = std::exchange(read.rate_hz, 0.0);
  require(rate_hz > 0.0, "--rate, in Hz, with --data frequency or phase");
  return analyze_series(flags.file, read, flags.data == "phase", rate_hz, options, flags.session);
}

/// What was identified, as noise to simulate: the worst axis, and a walk that was not resolved as its bound.
ImuNoise noise_of(const AllanResult& result) {
  const ImuNoiseEntry entry = noise_entry(result, "");
  ImuNoise noise;
  noise.gyro.white = entry.gyro_white;
  noise.accel.white = entry.accel_white;
  noise.gyro.walk = entry.gyro_walk.value.value_or(entry.gyro_walk.upper_bound.value_or(0.0));
  noise.accel.walk = entry.accel_walk.value.value_or(entry.accel_walk.upper_bound.value_or(0.0));
  return noise;
}

void run_self_test(AllanFlags& flags) {
  ReadOptions read = flags.read.options(0, flags.session);
  double rate_hz = read.rate_hz > 0.0 ? read.rate_hz : 200.0;
  double duration_s = flags.duration_s.value_or(kDefaultDuration_s);
  ImuNoise noise = flags.imu.simulation("imu0", rate_hz).imu.noise;
  if (!flags.file.empty()) {
    const AllanResult measured = analyze(flags);
    noise = noise_of(measured);
    rate_hz = measured.rate_hz;
    duration_s = flags.duration_s.value_or(measured.duration_s);
  }
  const SelfTest test = self_test(noise, rate_hz, duration_s, flags.runs, flags.imu.seed, analysis_options(flags));
  flags.session.finish();
  std::cout << (flags.session.json ? self_test_json(test, flags.session.context) : self_test_text(test));
}

void run_explain(const AllanFlags& flags) {
  const double rate_hz = flags.read.options(0, flags.session).rate_hz;
  require(rate_hz > 0.0, "--rate, in Hz, with --explain");
  const ImuUtilsExplanation explanation = explain_imu_utils_file(flags.explain, rate_hz, flags.duration_s);
  flags.session.finish(explanation.diagnostics);
  std::cout << to_text(explanation);
}

void run_file(AllanFlags& flags) {
  require(!flags.file.empty(), "a file to analyse, --self-test or --explain");
  require(flags.dialects.empty() || !flags.out.empty(), "--out with --export");
  check_dialects(flags.dialects);
  if (!flags.out.empty()) probe_output(flags.out + "/allan.json", 0, output_options(flags.session));
  const AllanResult result = analyze(flags);
  if (result.signals.size() > 0 && !result.signals[0].curves.empty() && !result.signals[0].curves[0].exact) {
    std::cerr << "note: the record is longer than " << kExactSamples
              << " samples; the curve was made in bounded memory (--memory exact holds it whole)\n";
  }
  flags.session.finish(result.diagnostics);
  std::vector<std::string> next;
  if (!flags.out.empty()) {
    const std::string title = std::filesystem::path(flags.file).filename().string();
    const std::string topic = flags.read.topic.empty() ? "" : flags.read.topic.front();
    next = write_allan(flags.out, result, flags.dialects, topic, title, flags.session);
  }
  std::cout << (flags.session.json ? allan_json(result, flags.session.context) : allan_text(result));
  if (!flags.out.empty()) std::cerr << "report: " << flags.out << "/report.html\n";
  for (const std::string& line : next) std::cerr << line << '\n';
}

void run(AllanFlags& flags) {
  if (flags.self_test) return run_self_test(flags);
  if (!flags.explain.empty()) return run_explain(flags);
  run_file(flags);
}

}  // namespace

void add_allan(CLI::App& app) {
  auto flags = std::make_shared<AllanFlags>();
  flags->imu.noise = "course";
  CLI::App* verb =
      app.add_subcommand("allan", "noise of a still IMU (or any series) by Allan deviation and likelihood");
  verb->add_option("file", flags->file, "a still recording, or a column of numbers with --data");
  verb->add_option("--data", flags->data, "imu; frequency or phase: one column of numbers at --rate")
      ->check(CLI::IsMember({"imu", "frequency", "phase"}));
  verb->add_option("--deviation", flags->deviations, "oadev, adev, mdev, tdev, hdev, ohdev, totdev")->delimiter(',');
  verb->add_option("--taus", flags->taus, "log (5 an octave), octave, decade, all, or a number of taus");
  verb->add_option("--memory", flags->memory, "exact, bounded (any length in constant memory) or auto")
      ->check(CLI::IsMember({"auto", "exact", "bounded"}));
  verb->add_option("--out", flags->out, "folder for report.html, curve.csv, allan.json and what --export names")
      ->check(not_empty());
  verb->add_option("--export", flags->dialects, "kalibr, openvins, vins-fusion, orbslam3, basalt, imu_utils")
      ->delimiter(',');
  verb->add_flag("--self-test", flags->self_test,
                 "simulate known noise of this rate and length (or of the file's), identify it, compare");
  verb->add_option("--runs", flags->runs, "of the self-test")->check(CLI::Range(1, 100000));
  verb->add_option("--duration", flags->duration_s, "[s] of the self-test, or of the record behind --explain")
      ->check(positive());
  verb->add_option("--explain", flags->explain, "an imu_utils yaml: what its numbers mean; with --rate");
  flags->imu.add_to(*verb);
  flags->read.add_to(*verb);
  add_session_flags(*verb, flags->session);
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli
