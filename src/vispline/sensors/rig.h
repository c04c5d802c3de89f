/// A rig: the named sensors that are rigid on one body, with their calibration and noise.
#pragma once

#include <string_view>
#include <vector>

#include "vispline/sensors/camera.h"
#include "vispline/sensors/imu.h"

namespace vispline {

struct Rig {
  std::vector<Imu> imus{};  ///< the first one is the reference
  std::vector<Camera> cameras{};
};

/// The IMU called `name`; nullptr if the rig has none.
const Imu* find_imu(const Rig& rig, std::string_view name);

/// The camera called `name`; nullptr if the rig has none.
const Camera* find_camera(const Rig& rig, std::string_view name);

/// Throws Error(kUsage, E-CONFIG) unless every sensor is valid and no two share a name.
void require_valid(const Rig& rig);

}  // namespace vispline
