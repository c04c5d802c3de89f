#include "vispline/io/recording_survey.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <utility>

#include "vispline/io/bag_messages.h"
#include "vispline/io/topic_choice.h"

namespace vispline {
namespace {

constexpr std::array<std::string_view, 2> kImageTypes = {"sensor_msgs/Image", "sensor_msgs/CompressedImage"};

template <class T>
std::optional<ros::Header> header_as(Bytes data, Wire wire) {
  const auto message = ros::decode<T>(data, wire);
  return message ? std::optional(message->header) : std::nullopt;
}

struct HeaderOf {
  std::string_view type;
  std::optional<ros::Header> (*read)(Bytes, Wire);
};

constexpr std::array kHeaders = {
    HeaderOf{"sensor_msgs/Imu", header_as<ros::Imu>},
    HeaderOf{"sensor_msgs/Image", header_as<ros::Image>},
    HeaderOf{"sensor_msgs/CompressedImage", header_as<ros::CompressedImage>},
    HeaderOf{"sensor_msgs/CameraInfo", header_as<ros::CameraInfo>},
    HeaderOf{"geometry_msgs/PoseStamped", header_as<ros::PoseStamped>},
    HeaderOf{"geometry_msgs/PoseWithCovarianceStamped", header_as<ros::PoseWithCovarianceStamped>},
    HeaderOf{"geometry_msgs/TransformStamped", header_as<ros::TransformStamped>},
    HeaderOf{"geometry_msgs/PointStamped", header_as<ros::PointStamped>},
    HeaderOf{"nav_msgs/Odometry", header_as<ros::Odometry>},
};

const HeaderOf* header_reader(const Topic& topic) {
  const auto found = std::ranges::find(kHeaders, ros::plain_type(topic.type), &HeaderOf::type);
  if (found == kHeaders.end() || ros::match(topic, found->type) != ros::Match::kSame) return nullptr;
  return &*found;
}

TopicUse use_of(const Topic& topic) {
  const auto is_in = [type = ros::plain_type(topic.type)](const auto& types) {
    return std::ranges::find(types, type) != types.end();
  };
  if (header_reader(topic) == nullptr) return TopicUse::kNone;
  if (is_in(kImuTypes)) return TopicUse::kImu;
  if (is_in(kPoseTypes)) return TopicUse::kPoses;
  return is_in(kImageTypes) ? TopicUse::kImages : TopicUse::kNone;
}

/// One topic while it is read.
class Measured {
 public:
  Measured(const Topic& topic, ReadContext& context)
      : reader_(header_reader(topic)), wire_(topic.wire), clock_(context) {
    survey_.name = topic.name;
    survey_.type = topic.type;
    survey_.encoding = topic.encoding;
    survey_.use = use_of(topic);
  }

  void take(const Message& message) {
    survey_.bytes += message.data.size();
    receive_.add(message.receive_ns);
    if (reader_ == nullptr) return;
    const auto header = reader_->read(message.data, wire_);
    survey_.undecoded += !header;
    if (!header) return;
    clock_.stamp(*header, message.receive_ns);
    if (header->stamp_valid) header_.add(header->stamp_ns);
  }

  TopicSurvey finish() {
    survey_.receive = receive_.rhythm();
    if (reader_ != nullptr) survey_.header = header_.rhythm();
    survey_.delay = clock_.delay();
    return std::move(survey_);
  }

 private:
  const HeaderOf* reader_;
  Wire wire_;
  MessageClock clock_;
  RhythmMeter receive_, header_;
  TopicSurvey survey_;
};

/// Connections of one name, type and encoding share one.
class Survey {
 public:
  Survey(const std::vector<Topic>& topics, ReadContext& context) {
    std::map<std::array<std::string, 3>, std::size_t> place;
    for (const Topic& topic : topics) {
      const auto [at, is_new] = place.try_emplace({topic.name, topic.type, topic.encoding}, measured_.size());
      if (is_new) measured_.emplace_back(topic, context);
      of_topic_.push_back(at->second);
    }
  }
  void take(const Message& message) { measured_[of_topic_[message.topic]].take(message); }
  std::vector<TopicSurvey> finish(const std::string& only) {
    std::vector<TopicSurvey> topics;
    for (Measured& one : measured_) topics.push_back(one.finish());
    if (!only.empty()) std::erase_if(topics, [&](const TopicSurvey& topic) { return topic.name != only; });
    return topics;
  }

 private:
  std::deque<Measured> measured_;
  std::vector<std::size_t> of_topic_;
};

}  // namespace

RecordingSurvey survey_recording(const std::string& path, const ReadOptions& options, const ReadProgress& progress) {
  ReadOptions tolerant = options;
  tolerant.repair = true;
  ReadContext context(path, "messages", tolerant);
  const auto reader = open_recording(context, progress);
  const std::vector<Topic>& topics = reader->topics();
  const auto is_wanted = [&](const Topic& topic) { return options.topic.empty() || topic.name == options.topic; };
  if (std::ranges::none_of(topics, is_wanted) && !options.topic.empty()) {
    context.fail(ExitCode::kUnfit, "E-TOPIC", "no topic " + vispline::quoted(options.topic), path,
                 "pass --topic with one of " + topic_list(topics, options.topic));
  }
  Survey survey(topics, context);
  reader->read(is_wanted, [&](const Message& message) {
    survey.take(message);
    return true;
  });
  return {.indexed = reader->indexed(),
          .topics = survey.finish(options.topic),
          .counts = reader->counts(),
          .diagnostics = reader->diagnostics(),
          .lost = reader->lost()};
}

}  // namespace vispline
