/// What makes a calibration impossible: used by every reader, with the place, and by every writer.
#pragma once

#include <string>

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/rig_calibration.h"

namespace vispline::rig_checks {

/// Empty if the camera can be: a known model with the right number of finite parameters, positive focal lengths, a
/// resolution from 1 to 65535. Else one phrase: "fu is -1, expected a positive number of px".
std::string problem_of(const CameraCalibration& camera);

/// A 4 x 4 matrix under `key`: E-CONFIG if its last row is not 0 0 0 1 or its rotation is off by more than 1e-3 or has
/// determinant -1; between 1e-6 and 1e-3 W-CONFIG and the nearest rotation; below it stays as it is.
Pose read_pose(ConfigMap& map, std::string_view key);

Matrix3d read_matrix3(ConfigMap& map, std::string_view key, std::string_view unit);

/// The rotation nearest to `R`, with E-CONFIG and W-CONFIG as for read_pose.
Matrix3d checked_rotation(ConfigMap& map, std::string_view key, const Matrix3d& R);

/// E-CONFIG at `key` of `map` if the camera has a problem.
void require_possible(const ConfigMap& map, std::string_view key, const CameraCalibration& camera);

}  // namespace vispline::rig_checks
