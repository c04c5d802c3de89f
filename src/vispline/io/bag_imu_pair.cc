#include "vispline/io/bag_imu_pair.h"

#include <algorithm>
#include <utility>

#include "vispline/io/bag_messages.h"
#include "vispline/io/imu_message.h"
#include "vispline/io/message_clock.h"
#include "vispline/io/topic_choice.h"

namespace vispline {
namespace {

constexpr std::int64_t kMaxApart = 100'000'000;             // 0.1 s between two readings of the accelerometer
constexpr std::size_t kMostWaiting = std::size_t{1} << 20;  ///< rows of one sensor that wait for the other

/// Specific force at `ns` in the straight line between two readings.
SensorRow between(SensorRow gyro, const SensorRow& a, const SensorRow& b) {
  const double part = b.ns == a.ns ? 0.0 : static_cast<double>(gyro.ns - a.ns) / static_cast<double>(b.ns - a.ns);
  for (std::size_t i = 0; i < 3; ++i) gyro.values[3 + i] = a.values[i] + part * (b.values[i] - a.values[i]);
  return gyro;
}

/// One of the two topics: its own counts and checks of stamps.
struct Half {
  Half(ReadContext& the_context, TopicChoice the_choice, StampScreen::Sink sink, std::size_t window)
      : context(the_context),
        choice(std::move(the_choice)),
        clock(the_context),
        screen(the_context, std::move(sink), window) {
    context.name_places(", topic " + vispline::quoted(choice.name) + ", message ");
  }
  void push(const ros::Header& header, std::int64_t receive_ns, const Vector3d& value) {
    SensorRow row{.ns = clock.stamp(header, receive_ns), .where = context.counts.read};
    std::copy_n(value.data(), 3, row.values.begin());
    screen.push(row);
  }
  void judge() {
    check_constant_time(context, screen.rows_in_range(), screen.rows_kept());
    clock.judge();
    screen.judge(1.0);
  }

  ReadContext& context;
  TopicChoice choice;
  MessageClock clock;
  StampScreen screen;
};

[[noreturn]] void fail_flags() {
  throw Error(ExitCode::kUsage,
              {.code = "E-ARGUMENT",
               .message = "a gyroscope and an accelerometer on two topics need both topics, and no third",
               .where = "--gyro-topic, --accel-topic",
               .effect = "nothing read",
               .next = "pass --gyro-topic and --accel-topic, without --topic"});
}

void must_fit(bool fits, const ReadContext& context) {
  if (fits) return;
  context.fail(ExitCode::kLimit, "E-LIMIT",
               "the two topics stand more than " + std::to_string(kMostWaiting) + " messages apart", context.path(),
               "put the messages of the recording in order of time");
}

}  // namespace

bool ImuPairing::push(std::deque<SensorRow>& queue, std::span<const SensorRow> rows) {
  queue.insert(queue.end(), rows.begin(), rows.end());
  while (!gyro_.empty() && settle_first(false)) gyro_.pop_front();
  return gyro_.size() <= kMostWaiting && accel_.size() <= kMostWaiting;
}

void ImuPairing::finish() {
  while (!gyro_.empty() && settle_first(true)) gyro_.pop_front();
}

/// False: the reading of the accelerometer behind it has not come yet.
bool ImuPairing::settle_first(bool last) {
  const SensorRow& gyro = gyro_.front();
  while (accel_.size() >= 2 && accel_[1].ns <= gyro.ns) accel_.pop_front();
  const bool starts_before = !accel_.empty() && accel_[0].ns <= gyro.ns;
  if (starts_before && accel_[0].ns == gyro.ns) return pair_(between(gyro, accel_[0], accel_[0])), true;
  if (starts_before && accel_.size() == 1 && !last) return false;
  if (accel_.empty() && !last) return false;
  const bool is_between = starts_before && accel_.size() >= 2 && accel_[1].ns - accel_[0].ns <= kMaxApart;
  if (is_between) {
    pair_(between(gyro, accel_[0], accel_[1]));
  } else {
    alone_(gyro);
  }
  return true;
}

ImuStreamResult stream_imu_pair(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                                const ImuStreamSettings& settings) {
  const bool named = !options.gyro_topic.empty() && !options.accel_topic.empty() && options.topic.empty();
  if (!named || options.gyro_topic == options.accel_topic) fail_flags();
  ReadContext context(path, "IMU samples", options), accel_context(path, "accelerometer samples", options);
  const auto reader = open_recording(context, settings.progress);
  const ImuFactors factors = imu_factors(options);
  ImuScreen screen(context, sink, {}, settings.window_rows);
  ImuPairing pairing(
      [&](const SensorRow& row) {
        const Vector3d gyro(row.values[0], row.values[1], row.values[2]);
        screen.push(row.ns, {gyro, {row.values[3], row.values[4], row.values[5]}}, row.where);
      },
      [&](const SensorRow& row) {
        context.drop("W-UNPAIRED", "no accelerometer within 0.1 s on both sides", context.where_line(row.where));
      });
  Half gyro(
      context, choose_topic(context, reader->topics(), options.gyro_topic, "--gyro-topic", kImuTypes),
      [&](std::span<const SensorRow> rows) { must_fit(pairing.push_gyro(rows), context); }, settings.window_rows);
  Half accel(
      accel_context, choose_topic(context, reader->topics(), options.accel_topic, "--accel-topic", kImuTypes),
      [&](std::span<const SensorRow> rows) { must_fit(pairing.push_accel(rows), context); }, settings.window_rows);
  std::vector<bool> wanted = gyro.choice.wanted;
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = wanted[i] || accel.choice.wanted[i];
  read_messages(context, *reader, wanted, [&](const Topic& topic, const Message& message) {
    const auto imu = ros::decode<ros::Imu>(message.data, topic.wire);
    if (!imu) return false;
    const bool is_gyro = topic.name == gyro.choice.name;
    if (!is_gyro) {
      --context.counts.read;
      ++accel_context.counts.read;
    }
    const ImuSample sample = imu_sample(*imu, factors);
    (is_gyro ? gyro : accel).push(imu->header, message.receive_ns, is_gyro ? sample.gyro : sample.accel);
    return true;
  });
  gyro.screen.flush();
  accel.screen.flush();
  pairing.finish();
  screen.flush();
  gyro.judge();
  accel.judge();
  context.diagnostics.merge(accel_context.diagnostics);
  screen.finish();
  return {.counts = std::move(context.counts),
          .diagnostics = std::move(context.diagnostics),
          .format = gyro.choice.type,
          .axes = {},
          .largest_window = screen.largest_window()};
}

}  // namespace vispline
