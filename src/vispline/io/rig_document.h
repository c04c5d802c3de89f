/// What a rig file says: instruments, gravity, and what an estimator shall do with each parameter. docs/formats.md,
/// Rigs.
#pragma once

#include <map>
#include <string>

#include "vispline/sensors/clock.h"
#include "vispline/sensors/rig.h"

namespace vispline {

/// What an estimator shall do with one parameter.
struct ParameterChoice {
  enum class Kind { kFree, kFixed, kPrior };
  Kind kind = Kind::kFree;
  double sigma = 0.0;  ///< standard deviation of the prior, per scalar, in the unit of the parameter; positive
  friend bool operator==(const ParameterChoice&, const ParameterChoice&) = default;
};

/// By "sensor.parameter", "cam0.intrinsics", or by a word without a dot: "gravity".
using ParameterChoices = std::map<std::string, ParameterChoice>;

struct RigDocument {
  Rig rig{};
  Vector3d g_w{0.0, 0.0, -9.81};  ///< m/s^2, points down
  ParameterChoices estimate{};
  ClockModels clocks{};  ///< of a simulation: when the sensors start, and how their clocks drift
};

}  // namespace vispline
