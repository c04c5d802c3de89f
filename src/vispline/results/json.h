/// JSON texts of results: schema first, then values with their SI unit in the key, then counts and diagnostics.
/// Every key is in docs/json.md. Same value, same bytes: fixed key order, no locale, shortest numbers that read back
/// equal; a number that is not finite is null.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/core/types.h"

namespace vispline {

/// An object under construction; keys keep the order in which they were first set. A value type: copies are deep.
class JsonObject {
 public:
  JsonObject();
  JsonObject(const JsonObject& other);
  JsonObject(JsonObject&& other) noexcept;
  JsonObject& operator=(JsonObject other) noexcept;
  ~JsonObject();

  JsonObject& set(std::string_view key, double value);
  JsonObject& set(std::string_view key, std::int64_t value);
  JsonObject& set(std::string_view key, int value) { return set(key, static_cast<std::int64_t>(value)); }
  JsonObject& set(std::string_view key, bool value);
  JsonObject& set(std::string_view key, std::string_view value);
  JsonObject& set(std::string_view key, const char* value) { return set(key, std::string_view(value)); }
  JsonObject& set(std::string_view key, const std::optional<double>& value);  ///< null if empty
  JsonObject& set(std::string_view key, const Vector3d& value);               ///< [x, y, z]
  JsonObject& set(std::string_view key, const Matrix3d& value);               ///< three rows
  JsonObject& set(std::string_view key, const std::vector<double>& value);
  JsonObject& set(std::string_view key, const std::vector<std::int64_t>& value);
  JsonObject& set(std::string_view key, const std::vector<std::string>& value);
  JsonObject& set(std::string_view key, const std::vector<std::vector<double>>& value);  ///< rows
  JsonObject& set(std::string_view key, const JsonObject& value);
  JsonObject& set(std::string_view key, const std::vector<JsonObject>& value);

  /// Indented by two blanks, ends with a newline. Bytes that are not UTF-8 become U+FFFD.
  std::string text() const;

 private:
  struct Node;
  std::unique_ptr<Node> node_;
};

/// The records of one input file.
struct JsonInput {
  std::string name;  ///< its role, such as "first" or "reference": no path, so that results do not depend on it
  ReadCounts counts;
};

/// What every document carries besides its result.
struct JsonContext {
  std::string version;            ///< of the program
  std::vector<JsonInput> inputs;  ///< none: the keys for inputs are left out
  Diagnostics diagnostics;        ///< of the readers and of the command; a result's own are added to them
};

/// {"schema", "version"}: how every document begins.
JsonObject begin_document(std::string_view schema, const JsonContext& context);
/// Adds samples_read, samples_kept, samples_dropped and inputs (if there are any), diagnostics, diagnostic_counts.
/// `own` are the diagnostics of the result.
void end_document(JsonObject& document, const JsonContext& context, const Diagnostics& own = {});

}  // namespace vispline
