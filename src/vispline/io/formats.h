/// The registry of text formats: adding one is a file with kName and recognizes, and one line in formats.cc.
#pragma once

#include <string>

#include "vispline/io/column_plan.h"
#include "vispline/io/text_layout.h"

namespace vispline {

/// What each column of the file is: from --columns, --format or the first format that recognizes the layout. Throws
/// E-COLUMNS if none does, E-ARGUMENT (exit 2) for an unknown --format. W-COLUMNS says which order was assumed.
ColumnPlan plan_columns(ReadContext& context, const TextLayout& layout);

/// E-COLUMNS: the columns hold something else than context.noun().
[[noreturn]] void fail_content(const ReadContext& context, const ColumnPlan& plan);

/// "euroc_imu, euroc_groundtruth, ..."
std::string format_names();

}  // namespace vispline
