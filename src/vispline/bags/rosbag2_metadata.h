/// metadata.yaml of a rosbag2 folder: which files belong to the recording.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vispline {

inline constexpr const char* kMetadataName = "metadata.yaml";

struct Rosbag2Metadata {
  std::vector<std::string> files;  ///< as they are written there
  std::optional<std::int64_t> messages;
  std::string wrong;  ///< why it cannot be used; empty if it can
};

/// Never throws for damage.
Rosbag2Metadata parse_metadata(const std::string& text);

}  // namespace vispline
