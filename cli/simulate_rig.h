/// vispline simulate --rig: a motion, a rig and a scene in, a folder of recordings with their truth out.
#pragma once

#include <string>

#include "flags.h"
#include "rig_flags.h"

namespace vispline::cli {

struct RigTask {
  RigFlags& flags;
  const ReadFlags& read;
  TrajectoryFlags trajectory;
  std::uint64_t seed = 0;
  std::size_t threads = 0;  ///< 0: all of the machine
  std::string out{};
};

void simulate_rig(const RigTask& task, Session& session);

}  // namespace vispline::cli
