#include "vispline/io/formats.h"

#include <array>

#include "vispline/io/course_pose.h"
#include "vispline/io/euroc_groundtruth.h"
#include "vispline/io/euroc_imu.h"
#include "vispline/io/gyroflow.h"
#include "vispline/io/kitti.h"
#include "vispline/io/mocap.h"
#include "vispline/io/plain_csv.h"
#include "vispline/io/recorders.h"
#include "vispline/io/tum.h"

namespace vispline {
namespace {

struct Format {
  std::string_view name;
  std::optional<ColumnPlan> (*recognizes)(const ReadContext&, const TextLayout&);
  ColumnPlan (*positional)(std::size_t fields);  ///< null: the format lives by names
};

/// In the order of asking: the more special first.
constexpr std::array kFormats = {
    Format{gyroflow::kName, gyroflow::recognizes, nullptr},
    Format{euroc_imu::kName, euroc_imu::recognizes, [](std::size_t) { return euroc_imu::positional(); }},
    Format{euroc_groundtruth::kName, euroc_groundtruth::recognizes,
           [](std::size_t) { return euroc_groundtruth::positional(); }},
    Format{mocap::kName, mocap::recognizes, [](std::size_t) { return mocap::positional(); }},
    Format{course_pose::kName, course_pose::recognizes, course_pose::positional},
    Format{tum::kName, tum::recognizes, [](std::size_t) { return tum::positional(); }},
    Format{plain_csv::kName, plain_csv::recognizes, nullptr},
};

std::size_t columns_used(const ColumnPlan& plan) {
  int last = -1;
  for (const int column : plan.column) last = std::max(last, column);
  return static_cast<std::size_t>(last + 1);
}

[[noreturn]] void fail_unknown(const ReadContext& context, const TextLayout& layout) {
  std::string names;
  for (const std::string& name : layout.header) names += (names.empty() ? "" : ",") + name;
  const std::string found =
      names.empty() ? std::to_string(layout.fields) + " columns without names" : vispline::quoted(names);
  context.fail(ExitCode::kInput, "E-COLUMNS", "no known order of columns in " + found, context.path(),
               "pass --columns with these names: " + known_column_names());
}

ColumnPlan plan_by_format(const ReadContext& context, const TextLayout& layout) {
  for (const Format& format : kFormats) {
    if (format.name != context.options().format) continue;
    if (format.positional == nullptr) {
      if (const auto plan = format.recognizes(context, layout)) return *plan;
      fail_unknown(context, layout);
    }
    const ColumnPlan plan = format.positional(layout.fields);
    if (columns_used(plan) <= layout.fields) return plan;
    context.fail(ExitCode::kInput, "E-COLUMNS",
                 "format " + std::string(format.name) + " needs " + std::to_string(columns_used(plan)) +
                     " columns, the file has " + std::to_string(layout.fields),
                 context.path(), "pass another --format, or --columns");
  }
  throw Error(ExitCode::kUsage, {.code = "E-ARGUMENT",
                                 .message = "unknown format " + vispline::quoted(context.options().format),
                                 .where = "--format",
                                 .effect = "nothing read",
                                 .next = "known formats: " + format_names()});
}

ColumnPlan find_plan(ReadContext& context, const TextLayout& layout) {
  for (const Format& format : kFormats) {
    const auto plan = format.recognizes(context, layout);
    if (!plan) continue;
    if (!plan->assumed.empty()) {
      context.warn("W-COLUMNS", "the file has no header; its columns are taken as " + plan->assumed, context.path(),
                   "all rows are read in this order", "pass --columns or --format to say so");
    }
    return *plan;
  }
  fail_unknown(context, layout);
}

}  // namespace

ColumnPlan plan_columns(ReadContext& context, const TextLayout& layout) {
  const ReadOptions& options = context.options();
  ColumnPlan plan;
  if (!options.columns.empty()) {
    plan = plan_by_flag(context, options.columns, layout.fields);
    plan.format = plain_csv::kName;
  } else {
    plan = options.format.empty() ? find_plan(context, layout) : plan_by_format(context, layout);
  }
  apply_unit_flags(options, plan);
  return plan;
}

void fail_content(const ReadContext& context, const ColumnPlan& plan) {
  const std::string holds = plan.has_imu()         ? "IMU samples"
                            : plan.has_poses()     ? "poses"
                            : plan.has(kGyroX, 3)  ? "a gyroscope and no accelerometer"
                            : plan.has(kAccelX, 3) ? "an accelerometer and no gyroscope"
                                                   : "neither poses nor IMU samples";
  context.fail(ExitCode::kInput, "E-COLUMNS", "no " + context.noun() + ": the columns hold " + holds, context.path(),
               "pass another file, or --columns with these names: " + known_column_names());
}

std::string format_names() {
  std::string names;
  for (const Format& format : kFormats) names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names + ", " + std::string(kitti::kName) + ", " + recorder_names();
}

}  // namespace vispline
