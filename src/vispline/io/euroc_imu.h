/// EuRoC imu0/data.csv: `#timestamp [ns],w_RS_S_x [rad s^-1],...,a_RS_S_z [m s^-2]`, also TUM-VI and Kalibr's bag
/// folders.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vispline/io/column_plan.h"
#include "vispline/sensors/recording.h"

namespace vispline::euroc_imu {

inline constexpr std::string_view kName = "euroc_imu";
inline constexpr std::string_view kOrder = "t gx gy gz ax ay az";
inline constexpr std::string_view kHeader =
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
    "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]";

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout);
/// By position, whatever the names.
ColumnPlan positional();

/// One line, with its line end: ns, then rad/s and m/s^2 with the shortest digits that read back the same.
void append_row(std::string& out, Time time, const ImuSample& sample);

}  // namespace vispline::euroc_imu
