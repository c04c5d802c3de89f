// vispline info FILE: what a file holds, and what is odd about it.
#include <filesystem>
#include <iostream>
#include <memory>

#include "flags.h"
#include "info_calibration.h"
#include "info_document.h"
#include "reading_progress.h"
#include "verbs.h"
#include "vispline/bags/open_bag.h"

namespace vispline::cli {
namespace {

struct InfoFlags {
  Session session;
  ReadFlags read;
  std::string path;
};

FileInfo info_of_recording(const std::string& path, const ReadOptions& options) {
  FileInfo info;
  const bool pair = !options.gyro_topic.empty() || !options.accel_topic.empty();
  info.recording = survey_recording(path, options, reading_progress("looking"));
  if (pair) info.signals.push_back(survey_imu(path, options, reading_progress("reading")));
  for (const TopicSurvey& topic : info.recording->topics) {
    if (pair || topic.receive.count == 0) continue;
    ReadOptions one = options;
    one.topic = topic.name;
    if (topic.use == TopicUse::kImu) info.signals.push_back(survey_imu(path, one, reading_progress("reading")));
    if (topic.use == TopicUse::kPoses) info.signals.push_back(survey_poses(path, one));
  }
  return info;
}

/// Of the formats that tell it. The MARS logger has it in movie_metadata.csv beside the samples.
std::optional<Readout> readout_of(const std::string& path, const std::vector<SignalSurvey>& signals) {
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(path).parent_path() / "movie_metadata.csv";
  if (fs::path(path).filename() == "gyro_accel.csv" && fs::is_regular_file(beside))
    return read_readout(beside.string());
  const bool tells = !signals.empty() && (signals[0].format == "gopro" || signals[0].format == "gcsv");
  return tells ? read_readout(path) : std::nullopt;
}

/// What keeps other verbs from using one signal of many is a finding here. The only one that was asked for ends the
/// program if it cannot be read.
bool ends_the_program(const SignalSurvey& signal, const FileInfo& info, bool named) {
  return signal.error && signal.error->exit_code() != ExitCode::kUnfit && (named || !info.recording);
}

void account(const FileInfo& info, bool named, Session& session) {
  if (info.recording) session.add(info.recording->diagnostics);
  for (const SignalSurvey& signal : info.signals) {
    if (!signal.error) {
      const std::string role = signal.imu ? "imu" : "trajectory";
      if (!info.recording) {
        session.add_input(role, signal.counts, signal.diagnostics);
        continue;
      }
      session.context.inputs.push_back({signal.name, signal.counts});
      session.add(signal.diagnostics);
      continue;
    }
    if (ends_the_program(signal, info, named)) continue;
    session.context.inputs.push_back({signal.name, signal.counts});
    Diagnostic finding = signal.error->diagnostic();
    finding.code.replace(0, 1, "W");
    finding.effect = "other verbs refuse this signal";
    session.add(finding);
  }
}

void run(InfoFlags& flags) {
  ReadOptions options = flags.read.options(0, flags.session);
  options.strict = false;
  if (is_calibration(flags.path)) {
    const std::optional<double> rate = options.rate_hz > 0.0 ? std::optional(options.rate_hz) : std::nullopt;
    return print_calibration(flags.path, rate, flags.session);
  }
  FileInfo info;
  if (is_bag(flags.path)) {
    info = info_of_recording(flags.path, options);
  } else {
    info.signals = survey_tables(flags.path, options, reading_progress("reading"));
    info.readout = readout_of(flags.path, info.signals);
  }
  const bool named = !options.topic.empty() || !options.gyro_topic.empty();
  account(info, named, flags.session);
  flags.session.finish();
  std::cout << (flags.session.json ? info_json(info, flags.session.context) : info_text(info)) << std::flush;
  for (const SignalSurvey& signal : info.signals) {
    if (ends_the_program(signal, info, named)) throw *signal.error;
  }
}

}  // namespace

void add_info(CLI::App& app) {
  auto flags = std::make_shared<InfoFlags>();
  CLI::App* verb = app.add_subcommand("info", "what a recording, table or calibration file holds, and what is odd");
  verb->add_option("file", flags->path, "bag, MCAP, rosbag2 or EuRoC folder, table, calibration or noise file")
      ->required();
  flags->read.add_to(*verb);
  add_session_flags(*verb, flags->session);
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli
