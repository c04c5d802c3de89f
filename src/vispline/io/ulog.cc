#include "vispline/io/ulog.h"

#include <cmath>
#include <optional>

#include "vispline/io/triad_pair.h"
#include "vispline/io/ulog_file.h"

namespace vispline::ulog {
namespace {

constexpr std::int64_t kMaxMicroseconds = INT64_MAX / 1000;
constexpr std::int64_t kNoRelativeTime = INT32_MAX;

struct Rows {
  std::vector<SensorRow> gyro, accel;
  std::int64_t short_messages = 0;
};

/// Three numbers of a message; nan where it has none.
SensorRow row_of(const Subscription& topic, Bytes message, std::int64_t us, const std::array<std::string, 3>& fields,
                 const std::array<std::size_t, 3>& index, double factor, std::int64_t where) {
  SensorRow row{.ns = us < 0 || us > kMaxMicroseconds ? kNoStamp : us * 1000, .where = where};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row.values[axis] = factor * number(topic, message, fields[axis], index[axis]).value_or(std::nan(""));
  }
  return row;
}

SensorRow array_row(const Subscription& topic, Bytes message, std::int64_t us, const std::string& field, double factor,
                    std::int64_t where) {
  return row_of(topic, message, us, {field, field, field}, {0, 1, 2}, factor, where);
}

/// When the sample was taken; without such a field when it was published.
std::optional<std::int64_t> stamp_of(const Subscription& topic, Bytes message) {
  if (const auto sample = integer(topic, message, "timestamp_sample"); sample && *sample != 0) return sample;
  return integer(topic, message, "timestamp");
}

/// Stamps of an accelerometer that is slower than the gyroscope repeat.
void add_newer(std::vector<SensorRow>& rows, const SensorRow& row) {
  if (row.ns != kNoStamp && (rows.empty() || row.ns > rows.back().ns)) rows.push_back(row);
}

void take_combined(const Subscription& topic, Bytes message, std::int64_t us, std::int64_t where, Rows& rows) {
  rows.gyro.push_back(array_row(topic, message, us, "gyro_rad", 1.0, where));
  const std::int64_t later = integer(topic, message, "accelerometer_timestamp_relative").value_or(0);
  if (later == kNoRelativeTime || us < 0 || us > kMaxMicroseconds) return;
  add_newer(rows.accel, array_row(topic, message, us + later, "accelerometer_m_s2", 1.0, where));
}

void take_increments(const Subscription& topic, Bytes message, std::int64_t us, std::int64_t where, Rows& rows) {
  const double gyro_dt = 1e-6 * number(topic, message, "delta_angle_dt").value_or(0.0);
  const double accel_dt = 1e-6 * number(topic, message, "delta_velocity_dt").value_or(0.0);
  if (!(gyro_dt > 0.0 && accel_dt > 0.0)) {
    ++rows.short_messages;
    return;
  }
  rows.gyro.push_back(array_row(topic, message, us, "delta_angle", 1.0 / gyro_dt, where));
  add_newer(rows.accel, array_row(topic, message, us, "delta_velocity", 1.0 / accel_dt, where));
}

void take_single(const Subscription& topic, Bytes message, std::int64_t us, std::int64_t where, Rows& rows) {
  const SensorRow row = row_of(topic, message, us, {"x", "y", "z"}, {0, 0, 0}, 1.0, where);
  if (topic.name == "sensor_gyro") rows.gyro.push_back(row);
  if (topic.name == "sensor_accel") add_newer(rows.accel, row);
}

/// A way to an IMU: the topics that make it up and how their messages are taken apart.
struct Source {
  std::array<std::string_view, 2> topics;  ///< the second may be empty
  void (*take)(const Subscription&, Bytes, std::int64_t us, std::int64_t where, Rows&);
};

constexpr std::array kSources = {
    Source{{"sensor_combined", ""}, take_combined},
    Source{{"vehicle_imu", ""}, take_increments},
    Source{{"sensor_gyro", "sensor_accel"}, take_single},
};

/// The lowest instance of a topic that has messages.
std::optional<int> instance_of(const Subscriptions& subscriptions, std::string_view name) {
  std::optional<int> lowest;
  for (const auto& [id, topic] : subscriptions) {
    if (topic.name == name && topic.messages > 0 && (!lowest || topic.instance < *lowest)) lowest = topic.instance;
  }
  return lowest;
}

const Source* source_of(const Subscriptions& subscriptions) {
  for (const Source& source : kSources) {
    if (instance_of(subscriptions, source.topics[0])) return &source;
  }
  return nullptr;
}

Rows load(const ReadContext& context, const Input& input, const Subscriptions& scanned, const Source& source) {
  Rows rows;
  std::array<std::optional<int>, 2> instance;
  for (std::size_t i = 0; i < 2; ++i) instance[i] = instance_of(scanned, source.topics[i]);
  Subscriptions again;
  walk(input, again, [&](const Subscription& topic, Bytes message, std::uint64_t offset) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (topic.name != source.topics[i] || topic.instance != instance[i]) continue;
      require_below(context, rows.gyro.size() + rows.accel.size(), "samples");
      if (const auto us = stamp_of(topic, message)) {
        source.take(topic, message, *us, static_cast<std::int64_t>(offset), rows);
      } else {
        ++rows.short_messages;
      }
    }
  });
  return rows;
}

void warn_damage(ReadContext& context, const Walked& walked, const Rows& rows) {
  if (walked.truncated) {
    context.warn("W-TRUNCATED", "the last message is cut", context.path(), "the messages before it are read");
  }
  if (walked.corrupt_bytes > 0) {
    context.warn("W-CORRUPT", std::to_string(walked.corrupt_bytes) + " bytes are no messages", context.path(),
                 "they are passed over");
  }
  context.counts.read += rows.short_messages;
  for (std::int64_t i = 0; i < rows.short_messages; ++i) {
    context.drop("W-MESSAGE", "a message without a stamp or an interval", context.path());
  }
}

}  // namespace

bool recognizes(Bytes head) { return as_text(head).starts_with(std::string_view("ULog\x01\x12\x35", 7)); }

ImuStreamResult stream(const Input& input, const ReadOptions& options, const ImuSink& sink,
                       const ImuStreamSettings& settings) {
  ReadContext context(input.name(), "IMU samples", options);
  context.name_places(", byte ");
  Subscriptions subscriptions;
  const Walked walked = walk(input, subscriptions, [](const Subscription&, Bytes, std::uint64_t) {});
  const Source* source = source_of(subscriptions);
  if (source == nullptr) {
    context.fail(ExitCode::kUnfit, "E-TOPIC", "no topic holds IMU samples", context.path(),
                 "log sensor_combined, vehicle_imu, or sensor_gyro and sensor_accel");
  }
  const Rows rows = load(context, input, subscriptions, *source);
  const bool g = !rows.gyro.empty(), a = !rows.accel.empty();
  const ImuAxes axes{.present = {g, g, g, a, a, a}};
  if (g || a) require_imu(context, axes, settings.whole_imu);
  warn_damage(context, walked, rows);
  ImuScreen screen(context, sink, axes, settings.window_rows);
  push_paired(context, rows.gyro, rows.accel, screen);
  screen.flush();
  screen.finish();
  return {.counts = std::move(context.counts),
          .diagnostics = std::move(context.diagnostics),
          .format = std::string(kName),
          .axes = axes,
          .largest_window = screen.largest_window(),
          .late = context.late};
}

}  // namespace vispline::ulog
