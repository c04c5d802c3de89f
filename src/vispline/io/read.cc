#include "vispline/io/read.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vispline/files/input_file.h"
#include "vispline/io/formats.h"
#include "vispline/io/imu_checks.h"
#include "vispline/io/rotations.h"
#include "vispline/io/stamp_rate.h"
#include "vispline/io/stamps.h"
#include "vispline/io/text_cells.h"
#include "vispline/io/text_table.h"

namespace vispline {
namespace {

/// Lost poses are ordinary (a marker out of sight); more than this is no trajectory.
constexpr double kMaxLostPoses = 0.5;
constexpr std::uint64_t kHeadBytes = std::uint64_t{1} << 22;

/// The text of a file, ready to be cut into lines.
std::string load_text(const std::string& path, std::uint64_t enough = UINT64_MAX) {
  std::string text = read_text_file(path, enough);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  normalise_line_ends(text);
  return text;
}

[[noreturn]] void fail_content(const ReadContext& context, const ColumnPlan& plan) {
  const std::string holds = plan.has_imu()     ? "IMU samples"
                            : plan.has_poses() ? "poses"
                                               : "neither poses nor IMU samples";
  context.fail(ExitCode::kInput, "E-COLUMNS", "no " + context.noun() + ": the columns hold " + holds, context.path(),
               "pass another file, or --columns with these names: " + known_column_names());
}

/// The numbers of the channels first .. first + count at rows that passed the checks of the stamps.
struct LoadedTable {
  TextTable table;
  ColumnPlan plan;
  StampedRows rows;
  double at(std::size_t i, int channel) const { return table.columns[static_cast<std::size_t>(channel)][rows.row[i]]; }
};

TimeUnit unit_of(const ReadContext& context, const ColumnPlan& plan, const std::vector<Decimal>& stamps) {
  if (plan.column[kTimeColumn] < 0) {
    context.fail(ExitCode::kInput, "E-TIME-UNIT",
                 plan.column[kIndexColumn] < 0 ? "the file has no column of times"
                                               : "the file counts samples, it has no column of times",
                 context.path(), "pass --time-unit index@RATE with the rate in Hz, such as index@200 or index@2000/7");
  }
  return settle_time_unit(context, stamps, plan.time_unit);
}

/// Stamps that are not in the file: the number of each row.
std::vector<Decimal> row_numbers(std::size_t rows) {
  std::vector<Decimal> stamps(rows);
  for (std::size_t i = 0; i < rows; ++i) stamps[i].whole = static_cast<std::int64_t>(i);
  return stamps;
}

bool same_values(const TextTable& table, std::size_t a, std::size_t b) {
  return std::all_of(table.columns.begin(), table.columns.end(), [&](const std::vector<double>& column) {
    return column[a] == column[b] || (std::isnan(column[a]) && std::isnan(column[b]));
  });
}

WantedColumns wanted_columns(const ColumnPlan& plan, Channel first, int count, bool by_index) {
  WantedColumns wanted;
  wanted.stamp = plan.column[by_index ? kIndexColumn : kTimeColumn];
  wanted.values.assign(plan.column.begin() + first, plan.column.begin() + first + count);
  return wanted;
}

LoadedTable load_table(ReadContext& context, Channel first, int count) {
  LoadedTable loaded;
  const std::string text = load_text(context.path());
  const TextLayout layout = find_layout(context, text);
  loaded.plan = plan_columns(context, layout);
  if (!loaded.plan.has(first, count)) fail_content(context, loaded.plan);
  std::optional<TimeUnit> asked;
  if (!context.options().time_unit.empty()) asked = parse_time_unit(context.options().time_unit);
  const bool by_index = asked ? asked->kind == TimeUnit::Kind::kIndex : loaded.plan.column[kTimeColumn] < 0;
  loaded.table = read_table(context, text, layout, wanted_columns(loaded.plan, first, count, by_index));
  std::vector<Decimal> stamps = std::move(loaded.table.stamps);
  if (by_index && loaded.plan.column[kIndexColumn] < 0) stamps = row_numbers(loaded.table.rows);
  const TimeUnit unit = asked ? *asked : unit_of(context, loaded.plan, stamps);
  loaded.rows = check_stamps(context, stamps, unit,
                             [&](std::size_t a, std::size_t b) { return same_values(loaded.table, a, b); });
  return loaded;
}

/// Rows with a number that is not finite become gaps; `allowed` is the share that may.
void drop_nonfinite(ReadContext& context, LoadedTable& loaded, double allowed) {
  std::vector<std::uint8_t> keep(loaded.rows.size(), 1);
  for (const std::vector<double>& column : loaded.table.columns) {
    for (std::size_t i = 0; i < keep.size(); ++i)
      keep[i] &= static_cast<std::uint8_t>(std::isfinite(column[loaded.rows.row[i]]));
  }
  const std::int64_t lost = std::count(keep.begin(), keep.end(), 0);
  if (lost == 0) return;
  if (context.share(lost) > allowed && !context.options().repair) {
    const auto first = std::find(keep.begin(), keep.end(), 0) - keep.begin();
    context.fail(
        ExitCode::kUnfit, "E-NONFINITE", percent(context.share(lost)) + " of the " + context.noun() + " are nan or inf",
        context.where_row(loaded.rows.row[static_cast<std::size_t>(first)]), "pass --repair to leave these rows out");
  }
  const std::string found = "nan or inf (" + percent(context.share(lost)) + " of the rows)";
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) context.drop("W-NONFINITE", found, context.where_row(loaded.rows.row[i]));
  }
  loaded.rows.keep(keep);
}

/// `--strict`: the first warning ends the run.
void check_strict(const ReadContext& context) {
  if (!context.options().strict || context.diagnostics.empty()) return;
  const Diagnostic& first = context.diagnostics.examples().front();
  const bool unfit = first.code == "W-NONFINITE" || first.code == "W-UNITS" || first.code == "W-CONSTANT" ||
                     first.code == "W-SATURATED" || first.code == "W-SPIKE";
  context.fail(unfit ? ExitCode::kUnfit : ExitCode::kInput, "E-" + first.code.substr(2), first.message, first.where,
               "leave out --strict to go on with a warning");
}

template <class Value>
ReadResult<Signal<Value>> finish(ReadContext& context, Signal<Value> signal, std::string format) {
  if (signal.empty()) {
    context.fail(ExitCode::kInput, "E-EMPTY",
                 "no " + context.noun() + " are left of " + std::to_string(context.counts.read) + " rows",
                 context.path(), "check that the recording was written");
  }
  context.counts.kept = static_cast<std::int64_t>(signal.size());
  check_strict(context);
  return {std::move(signal), std::move(context.counts), std::move(context.diagnostics), std::move(format)};
}

void require_rows(const ReadContext& context, const LoadedTable& loaded) {
  if (loaded.rows.size() > 0) return;
  context.fail(ExitCode::kInput, "E-EMPTY",
               "no " + context.noun() + " are left of " + std::to_string(context.counts.read) + " rows", context.path(),
               "check that the recording was written");
}

/// Entries whose flag is 0 are taken out of both, in step.
template <class Value>
void keep_entries(Signal<Value>& signal, StampedRows& rows, const std::vector<std::uint8_t>& keep) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    signal.time[out] = signal.time[i];
    signal.value[out++] = signal.value[i];
  }
  signal.time.resize(out);
  signal.value.resize(out);
  rows.keep(keep);
}

ImuSignal to_imu(const LoadedTable& loaded) {
  const double gyro = loaded.plan.gyro_unit.value_or(1.0), accel = loaded.plan.accel_unit.value_or(1.0);
  ImuSignal imu;
  imu.reserve(loaded.rows.size());
  for (std::size_t i = 0; i < loaded.rows.size(); ++i) {
    ImuSample sample;
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro[axis] = gyro * loaded.at(i, axis);
      sample.accel[axis] = accel * loaded.at(i, 3 + axis);
    }
    imu.push_back(time_from_ns(loaded.rows.ns[i]), sample);
  }
  return imu;
}

std::vector<Eigen::Quaterniond> quaternions_of(const LoadedTable& loaded) {
  std::vector<Eigen::Quaterniond> quaternions(loaded.rows.size());
  for (std::size_t i = 0; i < quaternions.size(); ++i) {
    quaternions[i].coeffs() << loaded.at(i, 3), loaded.at(i, 4), loaded.at(i, 5), loaded.at(i, 6);
  }
  return quaternions;
}

}  // namespace

ReadResult<ImuSignal> read_imu(const std::string& path, const ReadOptions& options) {
  ReadContext context(path, "IMU samples", options);
  LoadedTable loaded = load_table(context, kGyroX, 6);
  drop_nonfinite(context, loaded, kLoudLoss);
  require_rows(context, loaded);
  ImuSignal imu = to_imu(loaded);
  loaded.table = {};
  keep_entries(imu, loaded.rows, find_spikes(context, imu, loaded.rows));
  check_imu(context, imu);
  check_rate(context, loaded.rows);
  return finish(context, std::move(imu), loaded.plan.format);
}

ReadResult<Signal<Pose>> read_trajectory(const std::string& path, const ReadOptions& options) {
  ReadContext context(path, "poses", options);
  LoadedTable loaded = load_table(context, kPositionX, 7);
  drop_nonfinite(context, loaded, kMaxLostPoses);
  require_rows(context, loaded);
  std::vector<std::uint8_t> keep(loaded.rows.size(), 1);
  const std::vector<Matrix3d> R_w_b = to_rotations(context, quaternions_of(loaded), loaded.rows, keep);
  Signal<Pose> poses;
  poses.reserve(loaded.rows.size());
  for (std::size_t i = 0; i < loaded.rows.size(); ++i) {
    poses.push_back(time_from_ns(loaded.rows.ns[i]), {R_w_b[i], {loaded.at(i, 0), loaded.at(i, 1), loaded.at(i, 2)}});
  }
  keep_entries(poses, loaded.rows, keep);
  check_rate(context, loaded.rows);
  return finish(context, std::move(poses), loaded.plan.format);
}

ContentKind content_of(const std::string& path, const ReadOptions& options) {
  ReadContext context(path, "samples", options);
  const std::string text = load_text(path, kHeadBytes);
  const ColumnPlan plan = plan_columns(context, find_layout(context, text));
  if (plan.has_imu() && plan.has_poses()) return ContentKind::kBoth;
  if (plan.has_imu()) return ContentKind::kImu;
  if (plan.has_poses()) return ContentKind::kTrajectory;
  fail_content(context, plan);
}

}  // namespace vispline
