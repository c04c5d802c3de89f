/// What `vispline simulate --rig` was asked for, and what it is made of.
#pragma once

#include <string>

#include "flags.h"
#include "rig_flags.h"
#include "rig_scene.h"

namespace vispline::cli {

struct RigTask {
  RigFlags& flags;
  const ReadFlags& read;
  TrajectoryFlags trajectory;
  std::uint64_t seed = 0;
  std::size_t threads = 0;  ///< 0: all of the machine
  std::string out{};
};

struct RigInputs {
  RigDocument document{};
  TrajectorySource source;
  Time start{};
  Duration duration{};
  SceneSource scene{};
};

/// Rig, motion and scene.
RigInputs load_inputs(const RigTask& task, Session& session);

std::size_t threads_of(const RigTask& task);
/// The stamps of an IMU, from its phase on.
Stamps imu_stamps(const RigInputs& inputs, const Imu& imu);
ImuSimulation imu_simulation(const RigTask& task, const RigInputs& inputs, const Imu& imu);

}  // namespace vispline::cli
