/// Any table whose columns have known names, or seven columns without names: t, gyroscope, accelerometer.
#pragma once

#include <optional>
#include <string_view>

#include "vispline/io/column_plan.h"

namespace vispline::plain_csv {

inline constexpr std::string_view kName = "csv";

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout);

}  // namespace vispline::plain_csv
