/// Trajectory + rig -> recording.
#pragma once

#include <cstddef>
#include <cstdint>

#include "vispline/sensors/recording.h"
#include "vispline/sensors/rig.h"
#include "vispline/simulate/feature_simulation.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

struct RigSimulation {
  Vector3d g_w{0.0, 0.0, -9.81};  ///< m/s^2, gravitational acceleration: points down
  std::uint64_t seed = 0;
  std::size_t threads = 1;  ///< does not change a byte of the result
  ClockModels clocks{};
  FeatureSimulation features{};  ///< its clocks, seed and threads are those above
};

/// Everything the IMUs write down in [start, start + duration), each at its own rate. Sensors draw from streams of
/// their own name: adding one changes no other. Throws as require_valid(rig) and simulate_imu().
Recording simulate(const Trajectory& trajectory, const Rig& rig, Time start, Duration duration,
                   const RigSimulation& options = {});

/// The same and the features of the cameras. Throws as simulate_features() too.
Recording simulate(const Trajectory& trajectory, const Rig& rig, const Scene& scene, Time start, Duration duration,
                   const RigSimulation& options = {});

}  // namespace vispline
