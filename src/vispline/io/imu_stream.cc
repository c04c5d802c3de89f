#include "vispline/io/imu_stream.h"

#include <utility>
#include <vector>

#include "vispline/bags/open_bag.h"
#include "vispline/io/bag_imu.h"
#include "vispline/io/formats.h"
#include "vispline/io/recorders.h"
#include "vispline/io/sensor_folder.h"
#include "vispline/io/timed_rows.h"

namespace vispline {
namespace {

ImuAxes axes_of(const ColumnPlan& plan) {
  ImuAxes axes;
  for (std::size_t axis = 0; axis < kImuAxes; ++axis) axes.present[axis] = plan.column[kGyroX + axis] >= 0;
  return axes;
}

/// Single axes may only be left out by --columns: in a header their names may be misspelt.
bool are_enough(const ImuAxes& axes, bool whole, bool chosen) {
  if (whole) return axes.whole_gyro() && axes.whole_accel();
  if (!axes.has_gyro() && !axes.has_accel()) return false;
  return chosen || (axes.has_gyro() == axes.whole_gyro() && axes.has_accel() == axes.whole_accel());
}

ImuSample sample_of(const RowValues& values, double gyro, double accel) {
  return {gyro * Vector3d(values[0], values[1], values[2]), accel * Vector3d(values[3], values[4], values[5])};
}

}  // namespace

ImuStreamResult stream_imu(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                           const ImuStreamSettings& settings) {
  if (is_bag(path)) return stream_imu_bag(path, options, sink, settings);
  if (is_recorder(path, options)) return stream_recorder(path, options, sink, settings);
  ReadContext context(measurement_file(path, options, SensorKind::kImu), "IMU samples", options);
  TextLines lines(context, settings.block_bytes, settings.progress);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  lines.start_at(layout.data_begin, layout.data_line);
  const ColumnPlan plan = plan_columns(context, layout);
  const ImuAxes axes = axes_of(plan);
  if (!are_enough(axes, settings.whole_imu, !options.columns.empty())) fail_content(context, plan);
  const double gyro = plan.gyro_unit.value_or(1.0), accel = plan.accel_unit.value_or(1.0);

  const StampPlan stamps = plan_stamps(context, plan);
  const auto first = plan.column.begin() + kGyroX;
  TimedRows rows(context, lines, layout, stamps, {first, first + kImuAxes}, settings.window_rows);
  ImuScreen screen(context, sink, axes, settings.window_rows);
  for (SensorRow row; rows.next(row);) {
    screen.push(row.ns, sample_of(row.values, gyro, accel), row.where, row.scientific);
  }
  screen.flush();
  rows.check_constant(screen.stamps());
  screen.finish(rows.unit_ns());
  rows.check_step(screen.stamps());
  return {std::move(context.counts), std::move(context.diagnostics), plan.format, axes,
          screen.largest_window(),   lines.largest_buffer()};
}

}  // namespace vispline
