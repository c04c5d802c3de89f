/// The first IMU and the first camera of a simulated rig in the course's text files.
#pragma once

#include "rig_task.h"
#include "vispline/files/output_file.h"

namespace vispline::cli {

/// Throws E-ARGUMENT for a rig without IMU or camera, or with a rolling shutter.
void require_course(const Rig& rig);
/// Into the folder course of the output. Precondition: require_course().
void write_rig_course(const RigTask& task, const RigInputs& inputs, OutputOptions options);

}  // namespace vispline::cli
