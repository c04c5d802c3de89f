/// What a file is, judged by its bytes: the reader of text refuses everything else by name.
#pragma once

#include <optional>
#include <string_view>

namespace vispline {

/// "a rosbag", "UTF-16 text", "binary data", ...; empty if the bytes can be a table in ASCII or UTF-8.
/// Compressed text is not looked into: ask compression_of() first.
std::optional<std::string_view> not_text(std::string_view bytes);

}  // namespace vispline
