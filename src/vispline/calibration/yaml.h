/// YAML (and JSON, which is YAML in braces) from strangers: one map, without tags, of bounded size and depth.
/// docs/calibration-files.md, Limits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vispline {

namespace yaml_limits {
inline constexpr std::size_t kBytes = std::size_t{1} << 20;
inline constexpr std::size_t kDepth = 64;
inline constexpr std::size_t kNodes = 100'000;
inline constexpr std::size_t kMapKeys = 1000;       ///< of one map
inline constexpr std::size_t kAliasNodes = 10'000;  ///< made by aliases, in all
}  // namespace yaml_limits

/// Where a node or a key stands in the file, from 1.
struct YamlPlace {
  int line = 0;
  int column = 0;
};

struct YamlKey {
  std::string text;
  YamlPlace place;
};

/// One node; aliases are replaced by what they stand for.
struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };
  Kind kind = Kind::kNull;
  YamlPlace place{};
  std::string text{};             ///< of a scalar
  bool is_quoted = false;         ///< a scalar in quotes is text, whatever it looks like
  bool is_opencv_matrix = false;  ///< carries the tag !!opencv-matrix
  std::vector<YamlKey> keys{};    ///< of a map; no two are equal
  std::vector<YamlNode> items{};  ///< of a sequence, or the values of a map

  /// The value of `key`, null if this is not a map or has no such key.
  const YamlNode* find(std::string_view key) const;
};

struct YamlFile {
  std::string path;
  bool is_opencv = false;  ///< the first line is %YAML:1.0
  YamlNode root;           ///< a map

  /// "path:line:column"
  std::string at(YamlPlace place) const;
};

/// Throws Error: E-YAML (exit 2) with path:line:column for a syntax error, a tab in the indentation, an early end, a
/// control byte, a root that is not a map, a second document, an alias without an anchor and any tag, except
/// !!opencv-matrix under the head %YAML:1.0; E-CONFIG (exit 2) for a key that comes twice; E-LIMIT (exit 7) beyond
/// yaml_limits and for an alias inside its own anchor.
YamlFile parse_yaml(std::string path, std::string_view text);

/// Throws what read_small_text_file and parse_yaml throw.
YamlFile read_yaml(const std::string& path);

}  // namespace vispline
