/// The pose of a camera from points it knows. docs/math/estimate.md, Start values.
#pragma once

#include <optional>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/sensors/camera.h"

namespace vispline {

struct PnpResult {
  Pose T_t_c{};         ///< camera to target
  double rms_px = 0.0;  ///< of the points that count
  int inliers = 0;
};

/// From at least four points of a plane, or six that are in no plane; outliers are weighed down. Global shutter: the
/// whole image counts as one instant. Empty if the points do not determine a pose, or none of them is in front.
std::optional<PnpResult> camera_pose(const Camera& camera, const std::vector<Vector2d>& px,
                                     const std::vector<Vector3d>& point_t);

}  // namespace vispline
