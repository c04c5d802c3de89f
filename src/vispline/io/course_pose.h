/// The course simulator's imu_pose.txt and cam_pose.txt (14 columns) and imu_int_pose.txt (15): blanks, no header,
/// seconds.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vispline/core/pose.h"
#include "vispline/io/column_plan.h"

namespace vispline::course_pose {

inline constexpr std::string_view kName = "course";
/// Poses T_w_b and the IMU reading at the same instant.
inline constexpr std::string_view kOrder = "t qw qx qy qz px py pz gx gy gz ax ay az";
/// The dead-reckoned pose, written twice.
inline constexpr std::string_view kIntegratedOrder = "t qw qx qy qz px py pz - - - - - - -";

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout);
ColumnPlan positional(std::size_t fields);

/// Quaternion with w first, then position, each after a blank.
void append_pose(std::string& out, const Pose& T_w_b);

}  // namespace vispline::course_pose
