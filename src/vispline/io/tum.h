/// TUM trajectory: `timestamp tx ty tz qx qy qz qw`, seconds and metres, one blank between, as evo reads it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/io/column_plan.h"

namespace vispline::tum {

inline constexpr std::string_view kName = "tum";
inline constexpr std::string_view kOrder = "t px py pz qx qy qz qw";

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout);
ColumnPlan positional();

/// Stamps with nine decimals, numbers with the shortest digits that read back the same; no header.
std::string text(const Signal<Pose>& T_w_b);
void append_row(std::string& out, Time time, const Pose& T_w_b);

}  // namespace vispline::tum
