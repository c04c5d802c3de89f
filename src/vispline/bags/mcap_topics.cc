#include "vispline/bags/mcap_topics.h"

namespace vispline::mcap {
namespace {

Wire wire_of(const std::string& encoding) {
  if (encoding == "ros1") return Wire::kRos1;
  return encoding == "cdr" ? Wire::kCdr : Wire::kOther;
}

}  // namespace

bool TopicTable::add(const Channel& channel, std::vector<Topic>& topics) {
  if (channels_.contains(channel.id)) return true;
  Topic topic{.name = channel.topic,
              .type = {},
              .md5 = channel.md5,
              .definition = {},
              .wire = wire_of(channel.encoding),
              .encoding = channel.encoding};
  if (channel.schema != 0) {
    const auto schema = schemas_.find(channel.schema);
    if (schema == schemas_.end()) return false;
    topic.type = schema->second.name;
    topic.definition = schema->second.definition;
  }
  channels_[channel.id] = topics.size();
  topics.push_back(std::move(topic));
  return true;
}

std::optional<std::size_t> TopicTable::find(std::uint16_t channel) const {
  const auto found = channels_.find(channel);
  return found == channels_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace vispline::mcap
