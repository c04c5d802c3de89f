#include "vispline/io/bag_imu_pair.h"

#include <algorithm>
#include <utility>

#include "vispline/io/bag_messages.h"
#include "vispline/io/imu_message.h"
#include "vispline/io/message_clock.h"
#include "vispline/io/topic_choice.h"
#include "vispline/io/triad_pair.h"

namespace vispline {
namespace {

/// One of the two topics.
struct Half {
  Half(ReadContext& the_context, TopicChoice the_choice)
      : context(the_context), choice(std::move(the_choice)), clock(the_context) {
    context.name_places(", topic " + vispline::quoted(choice.name) + ", message ");
  }
  SensorRow row(const ros::Header& header, std::int64_t receive_ns, const Vector3d& value) {
    SensorRow row{.ns = clock.stamp(header, receive_ns), .where = ++messages};
    std::copy_n(value.data(), 3, row.values.begin());
    return row;
  }

  ReadContext& context;
  TopicChoice choice;
  MessageClock clock;
  std::int64_t messages = 0;
};

[[noreturn]] void fail_flags() {
  throw Error(ExitCode::kUsage,
              {.code = "E-ARGUMENT",
               .message = "a gyroscope and an accelerometer on two topics need both topics, and no third",
               .where = "--gyro-topic, --accel-topic",
               .effect = "nothing read",
               .next = "pass --gyro-topic and --accel-topic, without --topic"});
}

}  // namespace

ImuStreamResult stream_imu_pair(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                                const ImuStreamSettings& settings) {
  const bool named = !options.gyro_topic.empty() && !options.accel_topic.empty() && options.topic.empty();
  if (!named || options.gyro_topic == options.accel_topic) fail_flags();
  ReadContext context(path, "IMU samples", options), accel_context(path, "accelerometer samples", options);
  const auto reader = open_recording(context, settings.progress);
  const ImuFactors factors = imu_factors(options);
  Half gyro(context, choose_topic(context, reader->topics(), options.gyro_topic, "--gyro-topic", kImuTypes));
  Half accel(accel_context, choose_topic(context, reader->topics(), options.accel_topic, "--accel-topic", kImuTypes));
  TriadStream stream(context, accel_context, sink, {}, settings.whole_imu, settings.window_rows);
  std::vector<bool> wanted = gyro.choice.wanted;
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = wanted[i] || accel.choice.wanted[i];
  read_messages(context, *reader, wanted, [&](const Topic& topic, const Message& message) {
    const auto imu = ros::decode<ros::Imu>(message.data, topic.wire);
    if (!imu) return false;
    --context.counts.read;  // counted by the stream
    const ImuSample sample = imu_sample(*imu, factors);
    if (topic.name == gyro.choice.name) {
      stream.push_gyro(gyro.row(imu->header, message.receive_ns, sample.gyro));
    } else {
      stream.push_accel(accel.row(imu->header, message.receive_ns, sample.accel));
    }
    return true;
  });
  gyro.clock.judge();
  accel.clock.judge();
  stream.finish(other_clock(context));
  return {.counts = std::move(context.counts),
          .diagnostics = std::move(context.diagnostics),
          .format = gyro.choice.type,
          .axes = {},
          .largest_window = stream.largest_window(),
          .late = context.late + accel_context.late,
          .delay = gyro.clock.delay()};
}

}  // namespace vispline
