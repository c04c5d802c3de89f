/// KITTI poses: the upper three rows of T_w_b, row by row, twelve numbers a line and no time.
/// https://www.cvlibs.net/datasets/kitti/eval_odometry.php
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/io/stamp_screen.h"
#include "vispline/io/text_layout.h"
#include "vispline/io/text_lines.h"

namespace vispline::kitti {

inline constexpr std::string_view kName = "kitti";

/// Twelve columns without a header, whose first rows hold rotations; or the format is asked for.
bool recognizes(const ReadContext& context, const TextLayout& layout);

/// One row per pose: position, quaternion x y z w; stamped by --rate or index@RATE. `lines` must stand at the first
/// row. Throws E-TIME-UNIT without a rate, E-CSV for a malformed row or one that holds no rotation (off by more than
/// 0.1); W-ROTATION above 1e-3, and the nearest rotation is used. A last row that is cut is W-TRUNCATED.
std::vector<SensorRow> load(ReadContext& context, TextLines& lines, const TextLayout& layout);

std::string text(const Signal<Pose>& T_w_b);

}  // namespace vispline::kitti
