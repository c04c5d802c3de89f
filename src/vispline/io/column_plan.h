/// Which column of a table is what: found by name, by position, or told by --columns. docs/formats.md, Columns.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/io/read_context.h"
#include "vispline/io/text_layout.h"
#include "vispline/io/time_unit.h"

namespace vispline {

/// What a column can hold. Angular rate and specific force of the IMU in its own frame, and the pose T_w_b.
enum Channel : int {
  kTimeColumn,
  kIndexColumn,
  kSecColumn,   ///< whole seconds of a stamp in two columns
  kNsecColumn,  ///< and the nanoseconds that are added to them
  kGyroX,
  kGyroY,
  kGyroZ,
  kAccelX,
  kAccelY,
  kAccelZ,
  kPositionX,
  kPositionY,
  kPositionZ,
  kQuaternionX,
  kQuaternionY,
  kQuaternionZ,
  kQuaternionW,
  kChannels
};

/// A column name taken apart: "w_RS_S_x [rad s^-1]" is channel kGyroX with unit "rad s^-1".
struct ColumnName {
  std::optional<Channel> channel;
  std::string unit;  ///< lower case; empty if there is none
};

ColumnName parse_column_name(std::string_view name);

struct ColumnPlan {
  std::string format;  ///< kName
  std::array<int, kChannels> column;
  std::optional<TimeUnit> time_unit;
  std::optional<double> gyro_unit;   ///< rad/s per unit of the file; empty: none was named, rad/s
  std::optional<double> accel_unit;  ///< m/s^2 per unit of the file; empty: none was named, m/s^2
  std::string assumed;               ///< the order that was assumed for want of names; empty if nothing was

  ColumnPlan() { column.fill(-1); }
  bool has(Channel first, int count) const;
  bool has_imu() const { return has(kGyroX, 6); }
  bool has_poses() const { return has(kPositionX, 7); }
};

/// By name; columns of unknown names are left out. Throws E-COLUMNS if two columns have one meaning or a unit is
/// unknown.
ColumnPlan plan_by_names(const ReadContext& context, const std::vector<std::string>& names);

/// By position: one name for each column of the file, such as "t px py pz qx qy qz qw".
ColumnPlan plan_by_order(std::string_view order);

/// From the flag --columns. Throws E-COLUMNS (exit 2) for unknown names, (exit 3) for another number of columns.
ColumnPlan plan_by_flag(const ReadContext& context, const std::string& columns, std::size_t fields);

/// The factors to SI of the flags --gyro-unit and --accel-unit, which win over what the file says. Throws E-ARGUMENT
/// (exit 2) for unknown names.
void apply_unit_flags(const ReadOptions& options, ColumnPlan& plan);

/// Names that are known, for messages.
std::string known_column_names();

}  // namespace vispline
