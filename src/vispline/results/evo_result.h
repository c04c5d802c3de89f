/// A comparison of trajectories as a result file of evo, for evo_res and its plots.
/// https://github.com/MichaelGrupp/evo, evo/tools/file_interface.py
#pragma once

#include <string>

#include "vispline/results/trajectory_metrics.h"

namespace vispline {

/// A zip with info.json, stats.json, error_array.npy, timestamps.npy, seconds_from_start.npy, distances_from_start.npy
/// (along the reference), distances.npy (along the aligned estimate), alignment_transformation_sim3.npy, and both
/// trajectories as TUM text. The names are free text. Statistics are those of evo: std divides by n.
std::string evo_result_zip(const TrajectoryComparison& comparison, const std::string& reference_name,
                           const std::string& estimate_name);

}  // namespace vispline
