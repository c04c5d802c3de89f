#include "vispline/bags/rosbag2_metadata.h"

#include <yaml-cpp/yaml.h>

namespace vispline {
namespace {

constexpr std::size_t kMaxFiles = 10'000;

Rosbag2Metadata take(const YAML::Node& root) {
  Rosbag2Metadata metadata;
  const YAML::Node info = root["rosbag2_bagfile_information"];
  const YAML::Node files = info["relative_file_paths"];
  if (!info.IsMap() || !files.IsSequence() || files.size() == 0 || files.size() > kMaxFiles) {
    return {.files = {}, .messages = {}, .wrong = "it lists no files"};
  }
  for (const YAML::Node& file : files) metadata.files.push_back(file.as<std::string>());
  if (const YAML::Node count = info["message_count"]) metadata.messages = count.as<std::int64_t>();
  return metadata;
}

}  // namespace

Rosbag2Metadata parse_metadata(const std::string& text) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
  if (text.size() > kMaxBytes) return {.files = {}, .messages = {}, .wrong = "it is above 1 MiB"};
  try {
    return take(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    return {.files = {}, .messages = {}, .wrong = error.what()};
  }
}

}  // namespace vispline
