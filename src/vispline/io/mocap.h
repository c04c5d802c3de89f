/// Motion capture as in TUM-VI mocap0/data.csv: 8 columns, t [ns], p_RS_R [m], q_RS with w first.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/io/column_plan.h"

namespace vispline::mocap {

inline constexpr std::string_view kName = "mocap";
inline constexpr std::string_view kOrder = "t px py pz qw qx qy qz";
inline constexpr std::string_view kHeader =
    "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []";

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout);
ColumnPlan positional();

/// ns, position, quaternion with w first; comma separated, no line end.
void append_pose(std::string& out, Time time, const Pose& T_w_b);
std::string text(const Signal<Pose>& T_w_b);

}  // namespace vispline::mocap
