#include "vispline/io/copy_bag.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "vispline/bags/ros_encode.h"
#include "vispline/io/bag_messages.h"
#include "vispline/io/topic_choice.h"

namespace vispline {
namespace {

bool takes(Container container, Wire wire) {
  if (container == Container::kMcap) return true;
  return wire == (container == Container::kRosbag ? Wire::kRos1 : Wire::kCdr);
}

Wire other(Container container) { return container == Container::kRosbag ? Wire::kRos1 : Wire::kCdr; }

/// Where the messages of one topic go.
struct Route {
  std::optional<std::size_t> number;  ///< in the writer; absent: they are left out
  bool as_they_are = true;
};

Route route_of(const Topic& topic, Container container, BagWriter& writer) {
  if (takes(container, topic.wire)) return {writer.add_topic(topic), true};
  if (topic.wire == Wire::kOther || !ros::can_transcode(topic.type)) return {};
  if (ros::match(topic, ros::plain_type(topic.type)) != ros::Match::kSame) return {};
  return {writer.add_topic(ros::make_topic(topic.name, ros::plain_type(topic.type), other(container))), false};
}

}  // namespace

CopyResult copy_recording(const std::string& from, const ReadOptions& options, Container container,
                          const std::string& to, const BagWriterOptions& writing, const ReadProgress& progress) {
  ReadContext context(from, "messages", options);
  const auto reader = open_recording(context, progress);
  const std::vector<Topic>& topics = reader->topics();
  std::vector<bool> wanted;
  for (const Topic& topic : topics) wanted.push_back(options.topic.empty() || topic.name == options.topic);
  if (std::ranges::find(wanted, true) == wanted.end()) {
    context.fail(ExitCode::kUnfit, "E-TOPIC", "no topic " + vispline::quoted(options.topic), from,
                 "pass --topic with one of " + topic_list(topics, options.topic));
  }
  const auto writer = make_bag_writer(container, to, writing);
  std::vector<Route> routes(topics.size());
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (wanted[i]) routes[i] = route_of(topics[i], container, *writer);
  }
  std::string bytes;
  context.name_places(", message ");
  read_messages(context, *reader, wanted, [&](const Topic& topic, const Message& message) {
    const Route& route = routes[message.topic];
    if (!route.number) {
      context.drop("W-TYPE", "messages of type " + vispline::quoted(topic.type) + " have no place in this container",
                   "topic " + vispline::quoted(topic.name));
      return true;
    }
    Bytes data = message.data;
    if (!route.as_they_are) {
      if (!ros::transcode(topic.type, data, topic.wire, other(container), bytes)) return false;
      data = as_bytes(bytes);
    }
    writer->write(*route.number, message.receive_ns, data);
    ++context.counts.kept;
    return true;
  });
  writer->publish();
  return {std::move(context.counts), std::move(context.diagnostics)};
}

}  // namespace vispline
