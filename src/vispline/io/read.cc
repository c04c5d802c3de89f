#include "vispline/io/read.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "vispline/bags/open_bag.h"
#include "vispline/io/bag_messages.h"
#include "vispline/io/bag_poses.h"
#include "vispline/io/formats.h"
#include "vispline/io/imu_stream.h"
#include "vispline/io/kitti.h"
#include "vispline/io/read_end.h"
#include "vispline/io/recorders.h"
#include "vispline/io/rotations.h"
#include "vispline/io/sensor_folder.h"
#include "vispline/io/timed_rows.h"
#include "vispline/io/topic_choice.h"

namespace vispline {
namespace {

/// Lost poses are ordinary (a marker out of sight); more than this is no trajectory.
constexpr double kMaxLostPoses = 0.5;

bool is_finite(const SensorRow& row) {
  return std::all_of(row.values.begin(), row.values.end(), [](double value) { return std::isfinite(value); });
}

/// Rows with a number that is not finite become gaps.
void drop_nonfinite(ReadContext& context, std::vector<SensorRow>& rows) {
  const std::int64_t lost = static_cast<std::int64_t>(rows.size()) - std::count_if(rows.begin(), rows.end(), is_finite);
  if (lost == 0) return;
  const std::string share = percent(context.share(lost));
  if (context.share(lost) > kMaxLostPoses && !context.options().repair) {
    const auto first = std::find_if_not(rows.begin(), rows.end(), is_finite);
    context.fail(ExitCode::kUnfit, "E-NONFINITE", share + " of the " + context.noun() + " are nan or inf",
                 context.where_line(first->where), "pass --repair to leave these rows out");
  }
  for (const SensorRow& row : rows) {
    if (!is_finite(row))
      context.drop("W-NONFINITE", "nan or inf (" + share + " of the rows)", context.where_line(row.where));
  }
  std::erase_if(rows, [](const SensorRow& row) { return !is_finite(row); });
}

std::vector<Eigen::Quaterniond> quaternions_of(const std::vector<SensorRow>& rows) {
  std::vector<Eigen::Quaterniond> quaternions(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    quaternions[i].coeffs() << rows[i].values[3], rows[i].values[4], rows[i].values[5], rows[i].values[6];
  }
  return quaternions;
}

/// Rows whose quaternion is no rotation are left out.
Signal<Pose> to_poses(ReadContext& context, const std::vector<SensorRow>& rows) {
  std::vector<std::uint8_t> keep(rows.size(), 1);
  const std::vector<Matrix3d> R_w_b = to_rotations(context, quaternions_of(rows), rows, keep);
  RateCheck rate(context);
  Signal<Pose> poses;
  poses.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!keep[i]) continue;
    poses.push_back(time_from_ns(rows[i].ns), {R_w_b[i], {rows[i].values[0], rows[i].values[1], rows[i].values[2]}});
    rate.add(rows[i].ns, rows[i].where);
  }
  context.counts.kept = static_cast<std::int64_t>(poses.size());
  if (poses.empty()) fail_none_left(context);
  rate.judge();
  return poses;
}

PoseRows load_table_poses(ReadContext& context) {
  TextLines lines(context);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  lines.start_at(layout.data_begin, layout.data_line);
  if (kitti::recognizes(context, layout)) return {kitti::load(context, lines, layout), std::string(kitti::kName)};
  const ColumnPlan plan = plan_columns(context, layout);
  if (!plan.has_poses()) fail_content(context, plan);
  const StampPlan stamps = plan_stamps(context, plan);
  const auto first = plan.column.begin() + kPositionX;
  TimedRows rows(context, lines, layout, stamps, {first, first + kMaxValues});
  PoseRows kept{.rows = {}, .format = plan.format};
  StampScreen screen(context, [&](std::span<const SensorRow> block) {
    kept.rows.insert(kept.rows.end(), block.begin(), block.end());
  });
  for (SensorRow row; rows.next(row);) screen.push(row);
  screen.flush();
  rows.check_constant(screen);
  screen.judge(rows.unit_ns());
  rows.check_step(screen);
  return kept;
}

/// Of the topic that is named, or of all.
ContentKind content_of_bag(const ReadContext& context) {
  const ReadOptions& options = context.options();
  const auto reader = open_recording(context);
  std::vector<Topic> topics = reader->topics();
  if (!options.topic.empty()) std::erase_if(topics, [&](const Topic& topic) { return topic.name != options.topic; });
  const bool imu = has_topic_of(topics, kImuTypes), poses = has_topic_of(topics, kPoseTypes);
  if (imu && poses) return ContentKind::kBoth;
  if (imu || !options.gyro_topic.empty()) return ContentKind::kImu;
  if (poses) return ContentKind::kTrajectory;
  context.fail(ExitCode::kUnfit, "E-TOPIC", "no topic holds poses or IMU samples", context.path(),
               "the recording holds " + topic_list(reader->topics(), options.topic));
}

}  // namespace

ReadResult<ImuSignal> read_imu(const std::string& path, const ReadOptions& options) {
  ImuSignal imu;
  const auto append = [&imu](std::span<const Time> time, std::span<const ImuSample> samples) {
    imu.time.insert(imu.time.end(), time.begin(), time.end());
    imu.value.insert(imu.value.end(), samples.begin(), samples.end());
  };
  ImuStreamResult result = stream_imu(path, options, append, {.whole_imu = true});
  return {std::move(imu), std::move(result.counts), std::move(result.diagnostics), std::move(result.format)};
}

ReadResult<Signal<Pose>> read_trajectory(const std::string& path, const ReadOptions& options) {
  const bool is_recording = is_bag(path);
  ReadContext context(is_recording ? path : measurement_file(path, options, SensorKind::kPoses), "poses", options);
  PoseRows loaded = is_recording ? load_bag_poses(context) : load_table_poses(context);
  drop_nonfinite(context, loaded.rows);
  Signal<Pose> poses = to_poses(context, loaded.rows);
  check_strict(context);
  return {std::move(poses), std::move(context.counts), std::move(context.diagnostics), std::move(loaded.format)};
}

ContentKind content_of(const std::string& path, const ReadOptions& options) {
  if (is_bag(path)) return content_of_bag(ReadContext(path, "samples", options));
  if (is_recorder(path, options)) return ContentKind::kImu;
  ReadContext context(measurement_file(path, options, SensorKind::kAny), "samples", options);
  TextLines lines(context);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  if (kitti::recognizes(context, layout)) return ContentKind::kTrajectory;
  const ColumnPlan plan = plan_columns(context, layout);
  if (plan.has_imu() && plan.has_poses()) return ContentKind::kBoth;
  if (plan.has_imu()) return ContentKind::kImu;
  if (plan.has_poses()) return ContentKind::kTrajectory;
  fail_content(context, plan);
}

}  // namespace vispline
