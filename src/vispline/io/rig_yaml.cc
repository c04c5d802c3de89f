#include "vispline/io/rig_yaml.h"

#include <algorithm>
#include <array>

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/calibration/rig_text.h"
#include "vispline/io/rig_convert.h"
#include "vispline/io/rig_yaml_blocks.h"

namespace vispline::rig_yaml {
using namespace dialect;
namespace {

constexpr const char* kVersionKey = "vispline_rig";
constexpr int kVersion = 1;
constexpr std::array<const char*, 4> kDirections = {"down", "up", "right", "left"};  // as ReadoutDirection

struct NoiseKey {
  const char* key;
  double NoiseModel::*member;
  const char* unit;  ///< times rad/s or m/s^2
};

constexpr NoiseKey kNoiseKeys[] = {
    {"noise_density", &NoiseModel::white, "/sqrt(Hz), white noise N"},
    {"random_walk", &NoiseModel::walk, "/s/sqrt(Hz), bias random walk K"},
    {"bias_instability", &NoiseModel::bias_instability, ", flicker coefficient B"},
    {"turn_on_bias", &NoiseModel::turn_on_bias, ", standard deviation of the bias at the start"},
    {"quantum", &NoiseModel::quantum, ", least significant bit; 0: none"},
    {"range", &NoiseModel::range, ", saturation; 0: none"},
};

double not_negative(ConfigMap& map, std::string_view key, std::string_view unit, double absent) {
  const double value = map.number_if(key, unit).value_or(absent);
  if (!(value >= 0.0)) map.fail(key, "is " + brief(value) + ", expected a number that is not negative");
  return value;
}

/// "rad/s" or "m/s^2"
template <Sensor Model>
std::string unit_of() {
  return std::string(Model::kBlocks[block_index(Model::kBlocks, "bias")].unit);
}

template <Sensor Model>
void read_triad(ConfigMap& imu, typename Model::template Params<double>& params, NoiseModel& noise) {
  if (imu.has("T_b_i")) read_block(imu, "T_b_i", "m", params.T_b_i);
  params.time_offset_s = imu.number_if("time_offset", "s").value_or(params.time_offset_s);
  if (!imu.has(Model::kName)) return;
  ConfigMap map = imu.map(Model::kName);
  read_blocks<Model>(map, params);
  for (const NoiseKey& row : kNoiseKeys) {
    noise.*row.member = not_negative(map, row.key, unit_of<Model>() + row.unit, noise.*row.member);
  }
  map.warn_unknown();
}

void read_clock(ConfigMap& map, const std::string& name, ClockModels& clocks) {
  if (!map.has("phase") && !map.has("clock_drift")) return;
  clocks[name] = {not_negative(map, "phase", "s", 0.0), map.number_if("clock_drift", "s/s").value_or(0.0)};
}

Imu read_imu(ConfigMap& map, const std::string& name) {
  Imu imu{.name = name};
  imu.rate_hz = map.positive("rate_hz", "Hz");
  read_triad<Gyroscope>(map, imu.gyroscope, imu.noise.gyro);
  read_triad<Accelerometer>(map, imu.accelerometer, imu.noise.accel);
  return imu;
}

ReadoutDirection read_direction(ConfigMap& map) {
  const std::string word = map.text_or("readout", kDirections[0]);
  const auto found = std::ranges::find(kDirections, word);
  if (found == kDirections.end()) {
    map.fail("readout", "is " + vispline::quoted(word) + ", expected down, up, right or left");
  }
  return static_cast<ReadoutDirection>(found - kDirections.begin());
}

Camera read_camera(ConfigMap& map, const std::string& name) {
  const CameraCalibration calibration = kalibr_rig::read_camera(map, name);
  map.accept_all({"camera_model", "intrinsics", "distortion_model", "distortion_coeffs", "resolution", "T_cam_imu",
                  "timeshift_cam_imu", "line_delay", "cam_overlaps", "rostopic"});
  Camera camera = camera_of(calibration);
  camera.T_c_b = calibration.T_cam_imu.value_or(Pose{});
  camera.rate_hz = map.positive("rate_hz", "Hz");
  camera.shutter.direction = read_direction(map);
  camera.shutter.exposure_s = not_negative(map, "exposure", "s", camera.shutter.exposure_s);
  camera.pixel_sigma_px = not_negative(map, "pixel_sigma", "px", camera.pixel_sigma_px);
  return camera;
}

ParameterChoice read_choice(ConfigMap& map, const YamlKey& key, const YamlNode& node) {
  if (node.kind == YamlNode::Kind::kMap) {
    ConfigMap prior = map.map(key.text);
    const ParameterChoice choice{ParameterChoice::Kind::kPrior, prior.positive("sigma", "unit of the parameter")};
    prior.warn_unknown();
    return choice;
  }
  const std::string word = map.text(key.text);
  if (word == "free") return {ParameterChoice::Kind::kFree};
  if (word == "fixed") return {ParameterChoice::Kind::kFixed};
  map.fail(key.text, "is " + vispline::quoted(word) + ", expected free, fixed or {sigma: NUMBER}");
}

ParameterChoices read_choices(ConfigMap map, const Rig& rig) {
  ParameterChoices choices;
  for (std::size_t i = 0; i < map.node().keys.size(); ++i) {
    const YamlKey& key = map.node().keys[i];
    const std::size_t dot = key.text.find('.');
    const std::string sensor = key.text.substr(0, dot);
    if (dot != std::string::npos && !find_imu(rig, sensor) && !find_camera(rig, sensor)) {
      map.fail(key.text, "names " + vispline::quoted(sensor) + ", which the rig has not");
    }
    choices[key.text] = read_choice(map, key, map.node().items[i]);
  }
  return choices;
}

/// The maps below `section`, by their keys.
template <class Read>
void read_section(ConfigMap& root, const char* section, const Read& read) {
  if (!root.has(section)) return;
  ConfigMap map = root.map(section);
  for (const YamlKey& key : map.node().keys) {
    ConfigMap sensor = map.map(key.text);
    read(sensor, key.text);
    sensor.warn_unknown();
  }
}

template <Sensor Model>
std::string triad_text(const typename Model::template Params<double>& params, const NoiseModel& noise) {
  std::string text = "    " + std::string(Model::kName) + ":\n";
  for (const NoiseKey& row : kNoiseKeys) {
    text += value_line("      ", row.key, yaml_float(noise.*row.member), unit_of<Model>() + row.unit);
  }
  return text + block_lines<Model>("      ", params);
}

std::string clock_text(const ClockModels& clocks, const std::string& name) {
  const auto found = clocks.find(name);
  if (found == clocks.end()) return "";
  return value_line("    ", "phase", yaml_float(found->second.phase_s), "s, from the start to the first sample") +
         value_line("    ", "clock_drift", yaml_float(found->second.drift), "s/s");
}

std::string imu_text(const Imu& imu) {
  std::string text = "  " + yaml_string(imu.name) + ":\n";
  text += value_line("    ", "rate_hz", yaml_float(imu.rate_hz), "");
  text += triad_text<Gyroscope>(imu.gyroscope, imu.noise.gyro);
  return text + triad_text<Accelerometer>(imu.accelerometer, imu.noise.accel);
}

std::string camera_text(const Camera& camera) {
  const auto [model, distortion_model] = lens_words(camera.lens.model);
  const LensParams& params = camera.lens.params;
  const double* const split = params.data() + (model == "pinhole" ? 4 : model == "omni" ? 5 : 6);
  std::string text = "  " + yaml_string(camera.name) + ":\n";
  text += value_line("    ", "camera_model", std::string(model), "");
  text += value_line("    ", "intrinsics", list({params.data(), split}), "px");
  text += value_line("    ", "distortion_model", std::string(distortion_model), "");
  text += value_line("    ", "distortion_coeffs", list({split, params.data() + params.size()}), "");
  text += "    resolution: [" + std::to_string(camera.resolution_px[0]) + ", " +
          std::to_string(camera.resolution_px[1]) + "]  # px, width and height\n";
  text += rows("    ", "T_cam_imu", matrix4(camera.T_c_b), "body to camera, m");
  text += value_line("    ", "timeshift_cam_imu", yaml_float(camera.time_offset_s), "s: t_body = t_cam + timeshift");
  text += value_line("    ", "line_delay", yaml_float(camera.shutter.line_delay_s), "s from line to line");
  text += value_line("    ", "readout", kDirections[static_cast<std::size_t>(camera.shutter.direction)], "");
  text += value_line("    ", "exposure", yaml_float(camera.shutter.exposure_s), "s");
  text += value_line("    ", "rate_hz", yaml_float(camera.rate_hz), "");
  return text + value_line("    ", "pixel_sigma", yaml_float(camera.pixel_sigma_px), "px");
}

std::string choice_text(const ParameterChoice& choice) {
  if (choice.kind == ParameterChoice::Kind::kPrior) return "{sigma: " + yaml_float(choice.sigma) + "}";
  return choice.kind == ParameterChoice::Kind::kFree ? "free" : "fixed";
}

}  // namespace

bool recognizes(const YamlFile& file) { return file.root.find(kVersionKey) != nullptr; }

RigDocument read(const YamlFile& file, Diagnostics& diagnostics) {
  RigDocument document;
  ConfigMap root(file, file.root, "", diagnostics);
  root.integer(kVersionKey, "", kVersion, kVersion);
  if (root.has("gravity")) read_block(root, "gravity", "m/s^2", document.g_w);
  read_section(root, "imus", [&](ConfigMap& map, const std::string& name) {
    document.rig.imus.push_back(read_imu(map, name));
    read_clock(map, name, document.clocks);
  });
  read_section(root, "cameras", [&](ConfigMap& map, const std::string& name) {
    document.rig.cameras.push_back(read_camera(map, name));
    read_clock(map, name, document.clocks);
  });
  if (root.has("estimate")) document.estimate = read_choices(root.map("estimate"), document.rig);
  root.warn_unknown();
  return document;
}

std::string text(const RigDocument& document) {
  std::string text = std::string(kVersionKey) + ": " + std::to_string(kVersion) + "\n";
  text += value_line("", "gravity", list({document.g_w.data(), document.g_w.data() + 3}), "m/s^2, world, points down");
  if (!document.rig.imus.empty()) text += "imus:\n";
  for (const Imu& imu : document.rig.imus) text += imu_text(imu) + clock_text(document.clocks, imu.name);
  if (!document.rig.cameras.empty()) text += "cameras:\n";
  for (const Camera& camera : document.rig.cameras) {
    text += camera_text(camera) + clock_text(document.clocks, camera.name);
  }
  if (!document.estimate.empty()) text += "estimate:\n";
  for (const auto& [name, choice] : document.estimate) text += "  " + name + ": " + choice_text(choice) + "\n";
  return text;
}

}  // namespace vispline::rig_yaml
