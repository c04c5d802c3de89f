/// EuRoC state_groundtruth_estimate0/data.csv: 17 columns, t [ns], p, q (w first), v, gyroscope bias, accelerometer
/// bias. With rpng's short names (`#time(ns),px,...,bax,...`) too.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/io/column_plan.h"

namespace vispline {

/// A row of EuRoC ground truth.
struct GroundTruth {
  Pose T_w_b;
  Vector3d v_w = Vector3d::Zero();         ///< m/s
  Vector3d gyro_bias = Vector3d::Zero();   ///< rad/s, body
  Vector3d accel_bias = Vector3d::Zero();  ///< m/s^2, body
};

namespace euroc_groundtruth {

inline constexpr std::string_view kName = "euroc_groundtruth";
inline constexpr std::string_view kOrder = "t px py pz qw qx qy qz - - - - - - - - -";
inline constexpr std::string_view kHeader =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
    "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], "
    "b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], "
    "b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]";

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout);
ColumnPlan positional();
void append_row(std::string& out, Time time, const GroundTruth& state);
std::string text(const Signal<GroundTruth>& states);

}  // namespace euroc_groundtruth
}  // namespace vispline
