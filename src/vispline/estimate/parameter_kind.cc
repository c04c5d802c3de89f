#include "vispline/estimate/parameter_kind.h"

#include <array>
#include <cmath>

namespace vispline {
namespace {

constexpr std::array<const char*, 3> kAxis{"x", "y", "z"};
constexpr std::array<const char*, 3> kOthers{"y and z", "x and z", "x and y"};
constexpr double kOffsetLimit_s = 1e-3;
constexpr double kReadoutLimit_s = 1e-3;

struct Limits {
  const char* tail;  ///< of the name of the parameter
  double limit;
  const char* remedy;  ///< "@" stands for the axis, "%" for the other two
};

/// The table of docs/math/uncertainty.md, Limits.
constexpr Limits kLimits[] = {
    {".T_m_w.translation", 0.1, "move through more of the room"},
    {".T_m_w.rotation", 0.01, "move farther in all directions, and turn"},
    {".translation", 0.02, "turn faster about %"},
    {".rotation", 0.01, "turn about %, not about @ alone"},
    {".time_offset", kOffsetLimit_s, "change speed and rate of turn: a steady motion looks the same at any offset"},
    {".gyroscope.bias", 5e-3, "record longer, or with some rest"},
    {".gyroscope.scale", 0.02, "turn faster about @, both ways"},
    {".gyroscope.misalignment.lower", 0.02, "turn faster, about one axis after the other"},
    {".gyroscope.misalignment.upper", 0.02, "turn faster, about one axis after the other"},
    {".gyroscope.g_sensitivity", 1e-3, "shake along all axes while the sensor hardly turns"},
    {".accelerometer.bias", 0.2, "tilt the sensor: gravity must be seen along other axes than @"},
    {".accelerometer.scale", 0.02, "hold @ up, then down"},
    {".accelerometer.misalignment.lower", 0.02, "hold the sensor up and down along every axis"},
    {".accelerometer.misalignment.upper", 0.02, "hold the sensor up and down along every axis"},
    {"gravity.direction", 0.01, "tilt the sensor: direction of gravity and accelerometer bias are one otherwise"},
    {"gravity.magnitude", 0.1, "tilt the sensor through all directions"},
};

std::string filled(std::string_view words, std::size_t axis) {
  std::string text;
  for (const char c : words) {
    if (c == '@')
      text += kAxis[axis];
    else if (c == '%')
      text += kOthers[axis];
    else
      text += c;
  }
  return text;
}

std::string component_name(const Parameter& parameter, int k) {
  static constexpr std::array<const char*, 3> kBelow{"yx", "zx", "zy"}, kAbove{"xy", "xz", "yz"};
  static constexpr std::array<const char*, 9> kEntries{"xx", "yx", "zx", "xy", "yy", "zy", "xz", "yz", "zz"};
  const auto i = static_cast<std::size_t>(k);
  if (parameter.size == 1) return "";
  if (parameter.size == 2) return "tilt " + std::to_string(k + 1);
  if (parameter.size == 9) return kEntries[i];
  if (parameter.name.ends_with(".lower")) return kBelow[i];
  return parameter.name.ends_with(".upper") ? kAbove[i] : kAxis[i];
}

const Camera& camera_of(const Parameter& parameter, const State& state) {
  return *find_camera(state.rig, std::string_view(parameter.name).substr(0, parameter.name.find('.')));
}

ComponentKind lens_kind(const Lens& lens, int k) {
  const std::string name(lens_param_name(lens.model, k));
  const double value = std::abs(lens.params(k));
  if (name.starts_with("f")) {
    return {name, "px", 0.01 * value, "tilt the target or come closer: focal length is traded for distance otherwise"};
  }
  if (name.starts_with("p") && value > 2.0) {
    return {name, "px", 5.0, "turn about the optical axis, and tilt the target both ways"};
  }
  return {name, "1", 0.1, "bring the points into the corners of the image"};
}

}  // namespace

std::vector<ComponentKind> component_kinds(const Parameter& parameter, const State& state) {
  std::vector<ComponentKind> kinds;
  for (int k = 0; k < parameter.size; ++k) {
    if (parameter.name.ends_with(".intrinsics")) {
      kinds.push_back(lens_kind(camera_of(parameter, state).lens, k));
      continue;
    }
    ComponentKind& kind = kinds.emplace_back();
    kind.name = component_name(parameter, k);
    kind.unit = parameter.unit;
    if (parameter.name.ends_with(".line_delay")) {
      const Camera& camera = camera_of(parameter, state);
      kind.limit = kReadoutLimit_s / camera.shutter.lines(camera.resolution_px);
      kind.remedy = "move the camera faster: a rolling shutter shows only in fast images";
      continue;
    }
    for (const Limits& row : kLimits) {
      if (!parameter.name.ends_with(row.tail)) continue;
      kind.limit = row.limit;
      kind.remedy = filled(row.remedy, static_cast<std::size_t>(k % 3));
      break;
    }
  }
  return kinds;
}

std::vector<NamedComponent> named_components(const std::vector<Parameter>& parameters, const State& state) {
  std::vector<NamedComponent> all;
  for (const Parameter& parameter : parameters) {
    if (parameter.column < 0) continue;
    const std::vector<ComponentKind> kinds = component_kinds(parameter, state);
    for (int k = 0; k < parameter.size; ++k) {
      all.push_back({reported_name(parameter.name, state), k, parameter.size, kinds[static_cast<std::size_t>(k)]});
    }
  }
  return all;
}

std::string reported_name(const std::string& name, const State& state) {
  const std::size_t at = name.find(".T_c_b");
  if (at == std::string::npos || state.rig.imus.empty()) return name;
  const Pose& T_b_i = state.rig.imus.front().gyroscope.T_b_i;
  const bool body_is_imu = T_b_i.p.isZero(0.0) && T_b_i.R.isIdentity(0.0);
  return body_is_imu ? name.substr(0, at) + ".T_c_i" + name.substr(at + 6) : name;
}

}  // namespace vispline
