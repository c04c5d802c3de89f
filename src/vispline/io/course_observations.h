/// What the course's camera sees of the house: normalised image coordinates (x/z, y/z) of all that is in front of it.
#pragma once

#include <string>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/io/house.h"

namespace vispline {

/// "X Y Z 1" for each point.
std::string course_point_list(const std::vector<Vector3d>& points_w);
/// "X Y Z 1 u v" for each point in front of the camera.
std::string course_point_observations(const std::vector<Vector3d>& points_w, const Pose& T_w_c);
/// "u1 v1 u2 v2" for each segment with both ends in front of the camera.
std::string course_line_observations(const std::vector<Segment>& segments_w, const Pose& T_w_c);

}  // namespace vispline
