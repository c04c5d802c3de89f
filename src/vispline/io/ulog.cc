#include "vispline/io/ulog.h"

#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "vispline/io/triad_pair.h"
#include "vispline/io/ulog_file.h"

namespace vispline::ulog {
namespace {

constexpr std::int64_t kMaxMicroseconds = INT64_MAX / 1000;
constexpr std::int64_t kNoRelativeTime = INT32_MAX;

/// Takes the rows of one source, as they stand in the log.
struct Rows {
  std::function<void(const SensorRow&)> on_gyro, on_accel;
  std::int64_t short_messages = 0;
  std::int64_t last_accel = kNoStamp;

  /// Stamps of an accelerometer that is slower than the gyroscope repeat.
  void newer_accel(const SensorRow& row) {
    if (row.ns == kNoStamp || row.ns <= last_accel) return;
    last_accel = row.ns;
    on_accel(row);
  }
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

void take_combined(const Subscription& topic, Bytes message, std::int64_t us, std::int64_t where, Rows& rows) {
  rows.on_gyro(array_row(topic, message, us, "gyro_rad", 1.0, where));
  const std::int64_t later = integer(topic, message, "accelerometer_timestamp_relative").value_or(0);
  if (later == kNoRelativeTime || us < 0 || us > kMaxMicroseconds) return;
  if (later < -kMaxMicroseconds || later > kMaxMicroseconds) return;
  rows.newer_accel(array_row(topic, message, us + later, "accelerometer_m_s2", 1.0, where));
}

void take_increments(const Subscription& topic, Bytes message, std::int64_t us, std::int64_t where, Rows& rows) {
  const double gyro_dt = 1e-6 * number(topic, message, "delta_angle_dt").value_or(0.0);
  const double accel_dt = 1e-6 * number(topic, message, "delta_velocity_dt").value_or(0.0);
  if (!(gyro_dt > 0.0 && accel_dt > 0.0)) {
    ++rows.short_messages;
    return;
  }
  rows.on_gyro(array_row(topic, message, us, "delta_angle", 1.0 / gyro_dt, where));
  rows.newer_accel(array_row(topic, message, us, "delta_velocity", 1.0 / accel_dt, where));
}

void take_single(const Subscription& topic, Bytes message, std::int64_t us, std::int64_t where, Rows& rows) {
  const SensorRow row = row_of(topic, message, us, {"x", "y", "z"}, {0, 0, 0}, 1.0, where);
  if (topic.name == "sensor_gyro") rows.on_gyro(row);
  if (topic.name == "sensor_accel") rows.newer_accel(row);
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

/// The messages of a source, from front to end.
void take_all(const Input& input, const Subscriptions& scanned, const Source& source, const ReadProgress& progress,
              Rows& rows) {
  std::array<std::optional<int>, 2> instance;
  for (std::size_t i = 0; i < 2; ++i) instance[i] = instance_of(scanned, source.topics[i]);
  Subscriptions again;
  const auto take = [&](const Subscription& topic, Bytes message, std::uint64_t offset) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (topic.name != source.topics[i] || topic.instance != instance[i]) continue;
      if (const auto us = stamp_of(topic, message)) {
        source.take(topic, message, *us, static_cast<std::int64_t>(offset), rows);
      } else {
        ++rows.short_messages;
      }
    }
  };
  walk(input, again, take, progress);
}

ImuAxes axes_of(const Input& input, const Subscriptions& scanned, const Source& source, const ReadProgress& progress) {
  bool g = false, a = false;
  Rows rows{.on_gyro = [&](const SensorRow&) { g = true; }, .on_accel = [&](const SensorRow&) { a = true; }};
  take_all(input, scanned, source, progress, rows);
  return {.present = {g, g, g, a, a, a}};
}

void warn_damage(ReadContext& context, const Walked& walked) {
  if (walked.truncated) {
    context.warn("W-TRUNCATED", "the last message is cut", context.path(), "the messages before it are read");
  }
  if (walked.corrupt_bytes > 0) {
    context.warn("W-CORRUPT", std::to_string(walked.corrupt_bytes) + " bytes are no messages", context.path(),
                 "they are passed over");
  }
}

void drop_short(ReadContext& context, const Rows& rows) {
  context.counts.read += rows.short_messages;
  for (std::int64_t i = 0; i < rows.short_messages; ++i) {
    context.drop("W-MESSAGE", "a message without a stamp or an interval", context.path());
  }
}

}  // namespace

bool recognizes(Bytes head) { return as_text(head).starts_with(std::string_view("ULog\x01\x12\x35", 7)); }

ImuStreamResult stream(const Input& input, const ReadOptions& options, const ImuSink& sink,
                       const ImuStreamSettings& settings) {
  ReadContext context(input.name(), "IMU samples", options), accel_context(input.name(), "IMU samples", options);
  context.name_places(", byte ");
  accel_context.name_places(", byte ");
  Subscriptions subscriptions;
  const auto count_only = [](const Subscription&, Bytes, std::uint64_t) {};
  const Walked walked = walk(input, subscriptions, count_only, part_of(settings.progress, 0, 3));
  const Source* source = source_of(subscriptions);
  if (source == nullptr) {
    context.fail(ExitCode::kUnfit, "E-TOPIC", "no topic holds IMU samples", context.path(),
                 "log sensor_combined, vehicle_imu, or sensor_gyro and sensor_accel");
  }
  const ImuAxes axes = axes_of(input, subscriptions, *source, part_of(settings.progress, 1, 3));
  const bool whole_imu = settings.whole_imu && (axes.has_gyro() || axes.has_accel());
  TriadStream stream(context, accel_context, sink, axes, whole_imu, settings.window_rows);
  warn_damage(context, walked);
  Rows rows{.on_gyro = [&](const SensorRow& row) { stream.push_gyro(row); },
            .on_accel = [&](const SensorRow& row) { stream.push_accel(row); }};
  take_all(input, subscriptions, *source, part_of(settings.progress, 2, 3), rows);
  drop_short(context, rows);
  stream.finish("the clock of the log stands still");
  return {.counts = std::move(context.counts),
          .diagnostics = std::move(context.diagnostics),
          .format = std::string(kName),
          .axes = axes,
          .largest_window = stream.largest_window(),
          .late = context.late};
}

}  // namespace vispline::ulog
