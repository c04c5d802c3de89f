/// Gyroflow .gcsv: a first line `GYROFLOW IMU LOG`, lines `key,value` with the scales of the numbers, then a table
/// `t,gx,gy,gz[,ax,ay,az]`. Readings stay in the axes of the file; `orientation` is not applied.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vispline/io/column_plan.h"
#include "vispline/sensors/recording.h"

namespace vispline::gyroflow {

inline constexpr std::string_view kName = "gcsv";

/// Units from `tscale` (s), `gscale` (rad/s), `ascale` (g). Throws E-COLUMNS if one of them is absent or no number
/// above 0, or if the times are not in s, ms, us, ns or a whole number of ticks a second.
std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout);

/// Stamps in ns, numbers in rad/s and m/s^2 with the shortest digits that read back the same.
std::string text(const ImuSignal& imu, std::optional<double> readout_s);

}  // namespace vispline::gyroflow
