// vispline export CALIBRATION --for TOOL --out FILE: the parameter files of another tool, and the command that reads
// them.
#include <filesystem>
#include <iostream>
#include <memory>

#include "flags.h"
#include "validators.h"
#include "verbs.h"
#include "vispline/calibration/noise_files.h"
#include "vispline/io/rig_source.h"

namespace vispline::cli {
namespace {

namespace fs = std::filesystem;

struct ExportFlags {
  Session session;
  std::string path, tool, out, imu;
  RigReadOptions read;
  bool bake_timeshift = false;
};

/// A rig, or, without a camera, the noise of its IMU.
std::vector<NamedText> files_of(const std::string& tool, const RigCalibration& rig) {
  const bool only_noise = rig.cameras.empty() && !rig.imus.empty() && tool != "kalibr" && tool != "gyroflow";
  if (only_noise) return {noise_file(tool, rig.imus[0].noise)};
  return rig_files(tool, rig);
}

/// Where each file goes: the first is --out, the others stand beside it; all keep their names in a folder.
std::vector<std::string> places_of(const std::vector<NamedText>& files, const std::string& out) {
  std::error_code ignored;
  const bool folder = out.ends_with('/') || fs::is_directory(out, ignored);
  const fs::path parent = folder ? fs::path(out) : fs::path(out).parent_path();
  std::vector<std::string> places;
  for (const NamedText& file : files) places.push_back((parent / file.file_name).string());
  if (!folder) places[0] = out;
  return places;
}

/// The command with the names that the files got.
std::string command_of(const std::vector<NamedText>& files, const std::vector<std::string>& places) {
  std::string command = files[0].next_command;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string word = " " + files[i].file_name;
    const std::size_t at = (command + " ").find(word + " ");
    if (at != std::string::npos) command.replace(at, word.size(), " " + places[i]);
  }
  return command;
}

void print(const ExportFlags& flags, const std::vector<std::string>& places, const std::vector<std::string>& lost,
           const std::vector<std::string>& todo, const std::string& command) {
  if (!flags.session.json) {
    for (const std::string& place : places) std::cout << "wrote " << place << '\n';
    for (const std::string& note : lost) std::cout << "note: " << note << '\n';
    for (const std::string& step : todo) std::cout << "first: " << step << '\n';
    std::cout << "next: " << command << '\n';
    return;
  }
  const auto list = [](const char* key, const std::vector<std::string>& texts) {
    std::vector<JsonObject> objects;
    for (const std::string& text : texts) objects.push_back(JsonObject().set(key, text));
    return objects;
  };
  JsonObject document = begin_document("vispline.export/1", flags.session.context);
  document.set("tool", flags.tool).set("files", list("path", places)).set("notes", list("note", lost));
  document.set("first", list("step", todo)).set("next_command", command);
  end_document(document, flags.session.context);
  std::cout << document.text();
}

void run(ExportFlags& flags) {
  CalibrationSource source = read_rig_source(flags.path, flags.imu, flags.read);
  RigCalibration& rig = source.reading.rig;
  std::vector<std::string> lost = source.notes, todo;
  if (flags.bake_timeshift) todo = bake_timeshift(rig);
  const std::vector<NamedText> files = files_of(flags.tool, rig);
  if (source.paths.size() > 1) lost.push_back("the IMU is that of " + source.paths[1]);
  if (rig.imus.empty()) lost.push_back("no IMU is known: give its file with --imu");
  for (const NamedText& file : files) {
    for (const std::string& note : file.notes) {
      if (std::find(lost.begin(), lost.end(), note) == lost.end()) lost.push_back(note);
    }
  }
  flags.session.add(source.reading.diagnostics);
  flags.session.finish();
  const std::vector<std::string> places = places_of(files, flags.out);
  const OutputGuard guard;
  for (const std::string& place : places) probe_output(place, 0, output_options(flags.session));
  for (std::size_t i = 0; i < files.size(); ++i) {
    write_file(places[i], files[i].text, output_options(flags.session));
  }
  print(flags, places, lost, todo, command_of(files, places));
}

}  // namespace

void add_export(CLI::App& app) {
  auto flags = std::make_shared<ExportFlags>();
  CLI::App* verb = app.add_subcommand("export", "a calibration in the files of another tool");
  verb->add_option("calibration", flags->path,
                   "file of any of these tools, a rig file, or the folder or result.json of a result")
      ->required();
  verb->add_option("--for", flags->tool, "the tool")->required()->check(CLI::IsMember(rig_dialects()));
  verb->add_option("--out", flags->out, "its file (others of its set are written beside it), or a folder")
      ->required()
      ->check(not_empty());
  verb->add_option("--imu", flags->imu, "file with the IMU, where the calibration has none");
  verb->add_option("--rate", flags->read.rate_hz, "[Hz] of the IMU, for files of VINS-Fusion and imu_utils")
      ->check(positive());
  verb->add_flag("--bake-timeshift", flags->bake_timeshift,
                 "write the time shift as 0 and say what to add to the stamps of the images");
  add_session_flags(*verb, flags->session);
  verb->callback([flags] { run(*flags); });
}

}  // namespace vispline::cli
