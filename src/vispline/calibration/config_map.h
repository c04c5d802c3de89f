/// Typed values of one map of a parameter file. What is missing, misspelt or of the wrong kind is an error that names
/// the key, the place, the unit wanted and the nearest key; what nobody asks for is a warning.
#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/calibration/yaml.h"
#include "vispline/core/error.h"

namespace vispline {

/// A view: `file` and `diagnostics` must outlive it. Every getter throws E-CONFIG (exit 2).
class ConfigMap {
 public:
  /// `name` is what messages call it, "imu0"; empty for the root.
  ConfigMap(const YamlFile& file, const YamlNode& map, std::string name, Diagnostics& diagnostics);

  bool has(std::string_view key) const { return map_.find(key) != nullptr; }
  const YamlNode& node() const { return map_; }

  double number(std::string_view key, std::string_view unit);
  double positive(std::string_view key, std::string_view unit);
  /// Empty if the key is absent.
  std::optional<double> number_if(std::string_view key, std::string_view unit);
  /// Empty, with W-CONFIG, if the key is absent; but a key that is close to it and not known is its misspelling:
  /// E-CONFIG.
  std::optional<double> positive_or_warn(std::string_view key, std::string_view unit);
  /// .nan is a value: other tools write it.
  double number_or_nan(std::string_view key, std::string_view unit);
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string_view absent);
  /// Between `least` and `most`.
  int integer(std::string_view key, std::string_view unit, int least, int most);
  /// A sequence of `count` numbers, of any positive number of them if `count` is 0.
  std::vector<double> numbers(std::string_view key, std::size_t count, std::string_view unit);
  /// Row by row: a sequence of rows, one flat sequence, or an OpenCV matrix; rows x cols numbers.
  std::vector<double> matrix(std::string_view key, std::size_t rows, std::size_t cols, std::string_view unit);
  std::vector<int> integers(std::string_view key, int least, int most);
  /// The map under `key`.
  ConfigMap map(std::string_view key);
  /// The maps of the sequence under `key`.
  std::vector<ConfigMap> maps(std::string_view key);

  /// Calls `key` known, so that it gives no warning.
  void accept(std::string_view key) { asked_.emplace(key); }
  void accept_all(std::initializer_list<std::string_view> keys);
  /// W-CONFIG for every key that starts with `prefix` and that nobody asked for or accepted.
  void warn_unknown(std::string_view prefix = "");

  /// Place of the key, or of the map if it is absent: for messages of the caller.
  std::string where(std::string_view key) const;
  /// "imu0.update_rate"
  std::string full_name(std::string_view key) const;
  void warn(std::string_view key, const std::string& message);
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  const YamlNode& at(std::string_view key, std::string_view unit);
  std::string nearest_key(std::string_view key) const;
  double number_of(const YamlNode& node, std::string_view key, std::string_view unit) const;
  [[noreturn]] void fail_value(const YamlNode& node, std::string_view key, const std::string& wanted) const;

  const YamlFile& file_;
  const YamlNode& map_;
  std::string name_;
  Diagnostics& diagnostics_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace vispline
