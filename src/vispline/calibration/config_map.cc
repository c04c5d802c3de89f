#include "vispline/calibration/config_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "vispline/calibration/yaml_error.h"
#include "vispline/core/edit_distance.h"

namespace vispline {
namespace {

/// All of the text; .nan and .inf of YAML are not numbers here.
std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string described(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kNull:
      return "nothing";
    case YamlNode::Kind::kScalar:
      return vispline::quoted(node.text) + (node.is_quoted ? " in quotes" : "");
    case YamlNode::Kind::kSequence:
      return "a list of " + std::to_string(node.items.size());
    case YamlNode::Kind::kMap:
      return "a map";
  }
  return "";
}

std::string in_unit(std::string_view unit) { return unit.empty() ? "" : " in " + std::string(unit); }

}  // namespace

ConfigMap::ConfigMap(const YamlFile& file, const YamlNode& map, std::string name, Diagnostics& diagnostics)
    : file_(file), map_(map), name_(std::move(name)), diagnostics_(diagnostics) {
  if (map_.kind == YamlNode::Kind::kMap) return;
  fail_config((name_.empty() ? "the file" : name_) + " is " + described(map_) + ", expected keys with values",
              file_.at(map_.place));
}

std::string ConfigMap::full_name(std::string_view key) const {
  return name_.empty() ? std::string(key) : name_ + "." + std::string(key);
}

std::string ConfigMap::where(std::string_view key) const {
  const YamlNode* node = map_.find(key);
  return file_.at(node ? node->place : map_.place);
}

void ConfigMap::fail(std::string_view key, const std::string& message) const {
  fail_config(full_name(key) + " " + message, where(key));
}

void ConfigMap::fail_value(const YamlNode& node, std::string_view key, const std::string& wanted) const {
  // Where there is no value, its place is somewhere behind the key.
  const auto found = std::ranges::find(map_.keys, key, &YamlKey::text);
  const bool at_key = node.kind == YamlNode::Kind::kNull && found != map_.keys.end();
  fail_config(full_name(key) + " is " + described(node) + ", expected " + wanted,
              file_.at(at_key ? found->place : node.place));
}

void ConfigMap::warn(std::string_view key, const std::string& message) {
  diagnostics_.add(
      {.code = "W-CONFIG", .message = full_name(key) + " " + message, .where = where(key), .effect = "", .next = ""});
}

/// The key nobody asked for that is closest to `key`, with its line; empty if none is close.
std::string ConfigMap::nearest_key(std::string_view key) const {
  constexpr std::size_t kLongestKey = 80;
  std::size_t best = std::max<std::size_t>(2, key.size() / 4 + 1);
  std::string found;
  for (const YamlKey& candidate : map_.keys) {
    if (candidate.text.size() > kLongestKey || asked_.contains(candidate.text)) continue;
    const std::size_t distance = edit_distance(candidate.text, key);
    if (distance >= best) continue;
    best = distance;
    found = "line " + std::to_string(candidate.place.line) + " has " + vispline::quoted(candidate.text) +
            ": if it is meant, rename it";
  }
  return found;
}

const YamlNode& ConfigMap::at(std::string_view key, std::string_view unit) {
  if (const YamlNode* node = map_.find(key)) {
    asked_.emplace(key);
    return *node;
  }
  fail_config("key " + full_name(key) + (unit.empty() ? "" : " (" + std::string(unit) + ")") + " is missing",
              file_.at(map_.place), nearest_key(key));
}

double ConfigMap::number_of(const YamlNode& node, std::string_view key, std::string_view unit) const {
  const bool is_word = node.kind == YamlNode::Kind::kScalar && !node.is_quoted;
  const auto value = is_word ? parse_number(node.text) : std::nullopt;
  if (!value) fail_value(node, key, "a number" + in_unit(unit));
  return *value;
}

double ConfigMap::number(std::string_view key, std::string_view unit) { return number_of(at(key, unit), key, unit); }

double ConfigMap::positive(std::string_view key, std::string_view unit) {
  const YamlNode& node = at(key, unit);
  const double value = number_of(node, key, unit);
  if (!(value > 0.0)) fail_value(node, key, "a positive number" + in_unit(unit));
  return value;
}

std::optional<double> ConfigMap::number_if(std::string_view key, std::string_view unit) {
  return has(key) ? std::optional(number(key, unit)) : std::nullopt;
}

std::optional<double> ConfigMap::positive_or_warn(std::string_view key, std::string_view unit) {
  if (has(key) || !nearest_key(key).empty()) return positive(key, unit);
  warn(key, "(" + std::string(unit) + ") is missing");
  return std::nullopt;
}

double ConfigMap::number_or_nan(std::string_view key, std::string_view unit) {
  const YamlNode& node = at(key, unit);
  static constexpr std::string_view kNan[] = {".nan", ".Nan", ".NaN", ".NAN", "-.nan", "-.Nan", "nan", "-nan"};
  const bool is_nan = node.kind == YamlNode::Kind::kScalar && std::ranges::find(kNan, node.text) != std::end(kNan);
  return is_nan ? std::numeric_limits<double>::quiet_NaN() : number_of(node, key, unit);
}

std::string ConfigMap::text(std::string_view key) {
  const YamlNode& node = at(key, "");
  if (node.kind != YamlNode::Kind::kScalar) fail_value(node, key, "a text");
  return node.text;
}

std::string ConfigMap::text_or(std::string_view key, std::string_view absent) {
  return has(key) ? text(key) : std::string(absent);
}

int ConfigMap::integer(std::string_view key, std::string_view unit, int least, int most) {
  const YamlNode& node = at(key, unit);
  const double value = number_of(node, key, unit);
  if (value != std::floor(value) || value < least || value > most) {
    fail_value(node, key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return static_cast<int>(value);
}

std::vector<double> ConfigMap::numbers(std::string_view key, std::size_t count, std::string_view unit) {
  const YamlNode& node = at(key, unit);
  const bool fits =
      node.kind == YamlNode::Kind::kSequence && (count == 0 ? !node.items.empty() : node.items.size() == count);
  if (!fits)
    fail_value(node, key, "a list of " + (count ? std::to_string(count) + " " : "") + "numbers" + in_unit(unit));
  std::vector<double> values;
  for (const YamlNode& item : node.items) values.push_back(number_of(item, key, unit));
  return values;
}

std::vector<int> ConfigMap::integers(std::string_view key, int least, int most) {
  const YamlNode& node = at(key, "");
  if (node.kind != YamlNode::Kind::kSequence) fail_value(node, key, "a list of whole numbers");
  std::vector<int> values;
  for (const YamlNode& item : node.items) {
    const double value = number_of(item, key, "");
    if (value != std::floor(value) || value < least || value > most) {
      fail_value(item, key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    values.push_back(static_cast<int>(value));
  }
  return values;
}

std::vector<double> ConfigMap::matrix(std::string_view key, std::size_t rows, std::size_t cols, std::string_view unit) {
  const YamlNode& node = at(key, unit);
  const std::string size = std::to_string(rows) + " x " + std::to_string(cols);
  if (node.is_opencv_matrix) {
    ConfigMap opencv = map(key);
    for (const char* known : {"rows", "cols", "dt"}) opencv.accept(known);
    if (opencv.number("rows", "") != static_cast<double>(rows) ||
        opencv.number("cols", "") != static_cast<double>(cols)) {
      fail_value(node, key, "a matrix of " + size);
    }
    return opencv.numbers("data", rows * cols, unit);
  }
  const bool is_nested = node.kind == YamlNode::Kind::kSequence && node.items.size() == rows && !node.items.empty() &&
                         node.items[0].kind == YamlNode::Kind::kSequence;
  if (!is_nested) return numbers(key, rows * cols, unit);
  std::vector<double> values;
  for (const YamlNode& row : node.items) {
    if (row.kind != YamlNode::Kind::kSequence || row.items.size() != cols) fail_value(row, key, "rows of " + size);
    for (const YamlNode& item : row.items) values.push_back(number_of(item, key, unit));
  }
  return values;
}

ConfigMap ConfigMap::map(std::string_view key) { return {file_, at(key, ""), full_name(key), diagnostics_}; }

std::vector<ConfigMap> ConfigMap::maps(std::string_view key) {
  const YamlNode& node = at(key, "");
  if (node.kind != YamlNode::Kind::kSequence) fail_value(node, key, "a list");
  std::vector<ConfigMap> result;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    result.emplace_back(file_, node.items[i], full_name(key) + "[" + std::to_string(i) + "]", diagnostics_);
  }
  return result;
}

void ConfigMap::accept_all(std::initializer_list<std::string_view> keys) {
  for (const std::string_view key : keys) accept(key);
}

void ConfigMap::warn_unknown(std::string_view prefix) {
  for (const YamlKey& key : map_.keys) {
    if (asked_.contains(key.text) || !key.text.starts_with(prefix)) continue;
    diagnostics_.add({.code = "W-CONFIG",
                      .message = "unknown key " + vispline::quoted(full_name(key.text)),
                      .where = file_.at(key.place),
                      .effect = "not used",
                      .next = ""});
  }
}

}  // namespace vispline
