/// vispline simulate --rig: a motion, a rig and a scene in, a folder of recordings with their truth out.
#pragma once

#include "rig_task.h"

namespace vispline::cli {

void simulate_rig(const RigTask& task, Session& session);

}  // namespace vispline::cli
