#include "vispline/io/bag_imu.h"

#include <memory>
#include <optional>
#include <utility>

#include "vispline/io/bag_imu_pair.h"
#include "vispline/io/bag_messages.h"
#include "vispline/io/imu_message.h"
#include "vispline/io/message_clock.h"
#include "vispline/io/read_end.h"
#include "vispline/io/topic_choice.h"

namespace vispline {
namespace {

/// What is not measured is nan.
ImuSample masked(ImuSample sample, const ImuAxes& axes) {
  if (!axes.has_gyro()) sample.gyro.setConstant(NAN);
  if (!axes.has_accel()) sample.accel.setConstant(NAN);
  return sample;
}

void check_axes(const ReadContext& context, const TopicChoice& topic, const ImuAxes& axes, bool whole) {
  if (axes.has_gyro() && axes.has_accel()) return;
  if (!whole && (axes.has_gyro() || axes.has_accel())) return;
  context.fail(ExitCode::kUnfit, "E-TYPE",
               "topic " + vispline::quoted(topic.name) + " has no " +
                   (axes.has_gyro()    ? "accelerometer"
                    : axes.has_accel() ? "gyroscope"
                                       : "gyroscope and accelerometer") +
                   " (all zero, covariance -1)",
               context.path(), "pass --gyro-topic and --accel-topic if two topics hold them");
}

/// One topic with both.
class OneTopic {
 public:
  OneTopic(ReadContext& context, const TopicChoice& topic, const ImuSink& sink, const ImuStreamSettings& settings)
      : context_(context), topic_(topic), sink_(sink), settings_(settings), clock_(context) {}

  bool take(const Topic& topic, const Message& message) {
    const auto imu = ros::decode<ros::Imu>(message.data, topic.wire);
    if (!imu) return false;
    if (!screen_) begin(*imu);
    screen_->push(clock_.stamp(imu->header, message.receive_ns), masked(imu_sample(*imu, factors_), axes_),
                  context_.counts.read);
    return true;
  }

  ImuStreamResult finish() {
    if (!screen_) fail_none_left(context_);
    screen_->flush();
    check_constant_time(context_, screen_->stamps().rows_in_range(), screen_->stamps().rows_kept());
    clock_.judge();
    screen_->finish();
    return {.counts = std::move(context_.counts),
            .diagnostics = std::move(context_.diagnostics),
            .format = topic_.type,
            .axes = axes_,
            .largest_window = screen_->largest_window()};
  }

 private:
  void begin(const ros::Imu& first) {
    axes_ = measured_axes(first);
    check_axes(context_, topic_, axes_, settings_.whole_imu);
    screen_.emplace(context_, sink_, axes_, settings_.window_rows);
  }

  ReadContext& context_;
  const TopicChoice& topic_;
  const ImuSink& sink_;
  const ImuStreamSettings& settings_;
  MessageClock clock_;
  ImuFactors factors_ = imu_factors(context_.options());
  ImuAxes axes_;
  std::optional<ImuScreen> screen_;
};

}  // namespace

ImuStreamResult stream_imu_bag(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                               const ImuStreamSettings& settings) {
  if (!options.gyro_topic.empty() || !options.accel_topic.empty()) {
    return stream_imu_pair(path, options, sink, settings);
  }
  ReadContext context(path, "IMU samples", options);
  const auto reader = open_recording(context, settings.progress);
  const TopicChoice topic = choose_topic(context, reader->topics(), options.topic, "--topic", kImuTypes);
  context.name_places(", topic " + vispline::quoted(topic.name) + ", message ");
  OneTopic samples(context, topic, sink, settings);
  read_messages(context, *reader, topic.wanted,
                [&](const Topic& each, const Message& message) { return samples.take(each, message); });
  return samples.finish();
}

}  // namespace vispline
