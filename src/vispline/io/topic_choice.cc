#include "vispline/io/topic_choice.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "vispline/bags/ros_messages.h"
#include "vispline/core/edit_distance.h"

namespace vispline {
namespace {

constexpr std::size_t kMostListed = 20;
constexpr std::size_t kLongestName = 200;  ///< of which the distance is taken

/// All connections of one name.
struct Named {
  std::string name;
  std::vector<std::string> types;         ///< that differ
  std::optional<std::int64_t> count = 0;  ///< absent if it is not known of one of them
};

std::vector<Named> by_name(const std::vector<Topic>& topics) {
  std::map<std::string, std::size_t> place;
  std::vector<Named> named;
  for (const Topic& topic : topics) {
    const auto [at, is_new] = place.try_emplace(topic.name, named.size());
    if (is_new) named.push_back({.name = topic.name, .types = {}});
    Named& one = named[at->second];
    const std::string type = ros::plain_type(topic.type);
    if (std::ranges::find(one.types, type) == one.types.end()) one.types.push_back(type);
    one.count = one.count && topic.count ? std::optional(*one.count + *topic.count) : std::nullopt;
  }
  return named;
}

std::string types_of(const Named& topic) {
  std::string text;
  for (const std::string& type : topic.types) text += (text.empty() ? "" : " and ") + vispline::quoted(type);
  return text;
}

std::string described(const Named& topic) {
  return vispline::quoted(topic.name) + " (" + types_of(topic) +
         (topic.count ? ", " + std::to_string(*topic.count) + " messages)" : ")");
}

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

std::string listed(std::vector<Named> topics, const std::string& name) {
  const std::string_view wanted = std::string_view(name).substr(0, kLongestName);
  const auto distance = [&](const Named& topic) {
    return edit_distance(std::string_view(topic.name).substr(0, kLongestName), wanted);
  };
  if (!name.empty()) std::ranges::stable_sort(topics, {}, distance);
  std::string text;
  for (std::size_t i = 0; i < std::min(topics.size(), kMostListed); ++i) {
    text += (text.empty() ? "" : ", ") + described(topics[i]);
  }
  if (topics.size() > kMostListed) text += " and " + std::to_string(topics.size() - kMostListed) + " more";
  return text.empty() ? "none" : text;
}

bool has_type(const Named& topic, std::span<const std::string_view> types) {
  return std::ranges::any_of(topic.types,
                             [&](const auto& type) { return std::ranges::find(types, type) != types.end(); });
}

[[noreturn]] void fail_absent(const ReadContext& context, const std::vector<Named>& topics, const std::string& name,
                              std::string_view flag, std::span<const std::string_view> types) {
  const std::string message = name.empty() ? "no topic holds " + context.noun() + " (" + joined(types) + ")"
                                           : "no topic " + vispline::quoted(name);
  context.fail(
      ExitCode::kUnfit, "E-TOPIC", message, context.path(),
      (name.empty() ? "the recording holds " : "pass " + std::string(flag) + " with one of ") + listed(topics, name));
}

const Named& find_only(const ReadContext& context, const std::vector<Named>& topics, std::string_view flag,
                       std::span<const std::string_view> types) {
  std::vector<const Named*> fit, full;
  for (const Named& topic : topics) {
    if (!has_type(topic, types)) continue;
    fit.push_back(&topic);
    if (topic.count.value_or(1) > 0) full.push_back(&topic);
  }
  if (fit.empty()) fail_absent(context, topics, "", flag, types);
  if (full.size() > 1) {
    std::vector<Named> several;
    for (const Named* topic : full) several.push_back(*topic);
    context.fail(ExitCode::kUsage, "E-TOPIC-AMBIGUOUS", std::to_string(full.size()) + " topics hold " + context.noun(),
                 context.path(), "pass " + std::string(flag) + " with one of " + listed(several, ""));
  }
  return full.empty() ? *fit.front() : *full.front();
}

void check_type(const ReadContext& context, const Named& topic, std::span<const std::string_view> types) {
  if (topic.types.size() == 1 && has_type(topic, types)) return;
  context.fail(ExitCode::kUnfit, "E-TYPE",
               "topic " + vispline::quoted(topic.name) + " is of type " + types_of(topic) + ", which " +
                   (topic.types.size() > 1 ? "are several" : "holds no " + context.noun()),
               context.path(), "name a topic of one of the types " + joined(types));
}

void check_layout(const ReadContext& context, const Topic& topic, const std::string& type) {
  const std::string name = "topic " + vispline::quoted(topic.name);
  if (topic.wire == Wire::kOther) {
    context.fail(ExitCode::kInput, "E-UNSUPPORTED",
                 name + " is encoded as " + vispline::quoted(topic.encoding) + ", not as ROS 1 or CDR", context.path(),
                 "convert the recording to one of these");
  }
  if (ros::match(topic, type) == ros::Match::kSame) return;
  context.fail(ExitCode::kInput, "E-TYPE",
               name + " has messages " + type + " of a definition (md5 " + vispline::quoted(topic.md5) +
                   ") that is not the known one",
               context.path(), "convert the recording to the current definition of " + type);
}

}  // namespace

TopicChoice choose_topic(const ReadContext& context, const std::vector<Topic>& topics, const std::string& name,
                         std::string_view flag, std::span<const std::string_view> types) {
  const std::vector<Named> named = by_name(topics);
  const auto found = std::ranges::find(named, name, &Named::name);
  const bool by_flag = !name.empty();
  if (by_flag && found == named.end()) fail_absent(context, named, name, flag, types);
  const Named& topic = by_flag ? *found : find_only(context, named, flag, types);
  check_type(context, topic, types);
  TopicChoice choice{.name = topic.name, .type = topic.types.front(), .wanted = {}};
  for (const Topic& each : topics) {
    choice.wanted.push_back(each.name == topic.name);
    if (choice.wanted.back()) check_layout(context, each, choice.type);
  }
  return choice;
}

std::string topic_list(const std::vector<Topic>& topics, const std::string& name) {
  return listed(by_name(topics), name);
}

bool has_topic_of(const std::vector<Topic>& topics, std::span<const std::string_view> types) {
  return std::ranges::any_of(by_name(topics),
                             [&](const Named& topic) { return has_type(topic, types) && topic.count.value_or(1) > 0; });
}

}  // namespace vispline
