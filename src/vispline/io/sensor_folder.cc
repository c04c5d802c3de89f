#include "vispline/io/sensor_folder.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "vispline/core/edit_distance.h"

namespace vispline {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 1> kImuNames = {"imu"};
constexpr std::array<std::string_view, 5> kPoseNames = {"state_groundtruth_estimate", "mocap", "gt", "vicon",
                                                        "groundtruth"};
constexpr std::size_t kMostListed = 20;
constexpr std::size_t kMostEntries = 100'000;  ///< of a folder that are looked at

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

template <std::size_t n>
bool begins_with(const std::string& name, const std::array<std::string_view, n>& names) {
  return std::ranges::any_of(names, [&](std::string_view start) { return name.starts_with(start); });
}

bool is_of(const std::string& name, SensorKind kind) {
  const bool imu = begins_with(name, kImuNames), poses = begins_with(name, kPoseNames);
  return kind == SensorKind::kImu ? imu : (kind == SensorKind::kPoses ? poses : imu || poses);
}

std::string listed(const std::vector<SensorFile>& sensors) {
  std::string text;
  for (std::size_t i = 0; i < std::min(sensors.size(), kMostListed); ++i) {
    text += (text.empty() ? "" : ", ") + vispline::quoted(sensors[i].name);
  }
  return text + (sensors.size() > kMostListed ? ", ..." : "");
}

[[noreturn]] void fail(ExitCode exit_code, const std::string& code, const std::string& message,
                       const std::string& where, const std::string& next) {
  throw Error(exit_code, {.code = code, .message = message, .where = where, .effect = "nothing read", .next = next});
}

const SensorFile& named(const std::string& folder, std::vector<SensorFile>& sensors, const std::string& name) {
  const auto found = std::ranges::find(sensors, name, &SensorFile::name);
  if (found != sensors.end()) return *found;
  std::ranges::stable_sort(sensors, {}, [&](const SensorFile& sensor) { return edit_distance(sensor.name, name); });
  fail(ExitCode::kUnfit, "E-TOPIC", "no sensor " + vispline::quoted(name), folder,
       "pass --topic with one of " + listed(sensors));
}

const SensorFile& only(const std::string& folder, const std::vector<SensorFile>& sensors, SensorKind kind) {
  std::vector<SensorFile> fit;
  std::ranges::copy_if(sensors, std::back_inserter(fit), [&](const SensorFile& s) { return is_of(s.name, kind); });
  const std::string what = kind == SensorKind::kPoses ? "poses" : "IMU samples";
  if (fit.empty()) {
    fail(ExitCode::kUnfit, "E-TOPIC", "no sensor of this folder is known to hold " + what, folder,
         "pass --topic with one of " + listed(sensors));
  }
  if (fit.size() > 1 && kind != SensorKind::kAny) {
    fail(ExitCode::kUsage, "E-TOPIC-AMBIGUOUS", std::to_string(fit.size()) + " sensors hold " + what, folder,
         "pass --topic with one of " + listed(fit));
  }
  return *std::ranges::find(sensors, fit.front().name, &SensorFile::name);
}

}  // namespace

std::vector<SensorFile> sensor_files(const std::string& folder) {
  std::error_code error;
  const fs::path inner = fs::path(folder) / "mav0";
  const fs::path root = fs::is_directory(inner, error) ? inner : fs::path(folder);
  std::vector<SensorFile> sensors;
  if (is_file(root / "data.csv"))
    sensors.push_back({fs::path(folder).filename().string(), (root / "data.csv").string()});
  std::size_t seen = 0;
  for (fs::directory_iterator it(root, error), end; !error && it != end && seen < kMostEntries; it.increment(error)) {
    ++seen;
    const fs::path& entry = it->path();
    if (is_file(entry / "data.csv")) sensors.push_back({entry.filename().string(), (entry / "data.csv").string()});
    if (entry.extension() == ".csv" && entry.stem() != "data" && is_file(entry)) {
      sensors.push_back({entry.stem().string(), entry.string()});
    }
  }
  std::ranges::sort(sensors, {}, [](const SensorFile& s) { return std::pair(s.name, s.path); });
  return sensors;
}

std::string measurement_file(const std::string& path, const ReadOptions& options, SensorKind kind) {
  const bool has_topic = !options.topic.empty() || !options.gyro_topic.empty() || !options.accel_topic.empty();
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    if (!has_topic) return path;
    fail(ExitCode::kUsage, "E-ARGUMENT", "a topic is given, but " + vispline::quoted(path) + " is a single table",
         "--topic", "leave it out, or pass auto in its place for this input");
  }
  std::vector<SensorFile> sensors = sensor_files(path);
  if (sensors.empty()) {
    fail(ExitCode::kInput, "E-OPEN",
         "cannot read " + vispline::quoted(path) + ": it is a folder with neither metadata.yaml nor SENSOR/data.csv",
         path, "name a file, the folder of a rosbag2, or one that holds mav0");
  }
  if (!options.topic.empty()) return named(path, sensors, options.topic).path;
  if (sensors.size() == 1) return sensors.front().path;
  return only(path, sensors, kind).path;
}

}  // namespace vispline
