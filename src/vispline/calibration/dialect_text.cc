#include "vispline/calibration/dialect_text.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

namespace vispline::dialect {
namespace {
constexpr std::size_t kMaxSlug = 64;

template <class... Format>
std::string digits(double value, Format... format) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format...).ptr;
  return {buffer, end};
}

bool is_alnum(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

/// A word that starts with a letter or '/', so that no reader takes it for a number, a date or a mark of YAML.
bool is_plain(std::string_view text) {
  static constexpr std::string_view kReserved[] = {"y", "n", "yes", "no", "on", "off", "true", "false", "null"};
  if (text.empty() || (text[0] != '/' && !(is_alnum(text[0]) && (text[0] < '0' || text[0] > '9')))) return false;
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (std::ranges::find(kReserved, lower) != std::end(kReserved)) return false;
  return std::ranges::all_of(text, [](char c) { return is_alnum(c) || c == '_' || c == '-' || c == '/' || c == '.'; });
}
}  // namespace

std::string yaml_float(double value) {
  assert(std::isfinite(value));
  std::string text = digits(value);
  if (text.find('.') != std::string::npos) return text;
  text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string opencv_float(double value) { return digits(value, std::chars_format::scientific, 16); }

std::string brief(double value) { return digits(value, std::chars_format::general, 6); }

std::string yaml_string(std::string_view text) {
  if (is_plain(text)) return std::string(text);
  std::string quoted_text = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted_text += '\\';
      quoted_text += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      static constexpr char kHex[] = "0123456789ABCDEF";
      quoted_text += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      quoted_text += c;
    }
  }
  return quoted_text + '"';
}

std::string slug(std::string_view name) {
  std::string text(name.substr(0, kMaxSlug));
  for (char& c : text) c = is_alnum(c) || c == '-' ? c : '_';
  return text.find_first_not_of('_') == std::string::npos ? "imu" : text;
}

std::string value_line(std::string_view indent, std::string_view key, const std::string& value,
                       std::string_view comment) {
  std::string line(indent);
  line += key;
  line += ": " + value;
  if (!comment.empty()) (line += "  # ") += comment;
  return line + "\n";
}

std::optional<double> written_walk(const WalkEntry& walk) { return walk.value ? walk.value : walk.upper_bound; }

std::string walk_note(std::string_view key, const WalkEntry& walk) {
  return std::string(key) + (walk.upper_bound ? " is an upper bound: the record does not resolve the random walk"
                                              : " is left out: no value above 0 is known; set it by hand");
}

std::string walk_line(const WalkLine& line, const WalkEntry& walk, std::vector<std::string>& notes) {
  if (walk.value) return value_line(line.indent, line.key, yaml_float(*walk.value * line.factor), line.unit);
  notes.push_back(walk_note(line.key, walk));
  if (!walk.upper_bound) {
    return line.indent + "# " + line.key + ": no value above 0 is known; set it by hand, " + line.unit + "\n";
  }
  return value_line(line.indent, line.key, yaml_float(*walk.upper_bound * line.factor),
                    "upper bound, the record does not resolve the walk; " + line.unit);
}

}  // namespace vispline::dialect
