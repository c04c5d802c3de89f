#include "vispline/results/json.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace vispline {

struct JsonObject::Node {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
};

namespace {

constexpr int kIndent = 2;

JsonObject to_json(const std::map<std::string, std::int64_t>& counts) {
  JsonObject object;
  for (const auto& [code, count] : counts) object.set(code, count);
  return object;
}

JsonObject to_json(const Diagnostic& diagnostic) {
  JsonObject object;
  object.set("code", diagnostic.code).set("message", diagnostic.message).set("where", diagnostic.where);
  return object.set("effect", diagnostic.effect).set("next", diagnostic.next);
}

void set_counts(JsonObject& object, const ReadCounts& counts) {
  object.set("samples_read", counts.read).set("samples_kept", counts.kept);
  object.set("samples_dropped", to_json(counts.dropped));
}

void add(ReadCounts& total, const ReadCounts& counts) {
  total.read += counts.read;
  total.kept += counts.kept;
  for (const auto& [code, count] : counts.dropped) total.dropped[code] += count;
}

void set_inputs(JsonObject& document, const std::vector<JsonInput>& inputs) {
  if (inputs.empty()) return;
  ReadCounts total;
  std::vector<JsonObject> objects;
  for (const JsonInput& input : inputs) {
    add(total, input.counts);
    set_counts(objects.emplace_back().set("name", input.name), input.counts);
  }
  set_counts(document, total);
  document.set("inputs", objects);
}

}  // namespace

JsonObject::JsonObject() : node_(std::make_unique<Node>()) {}
JsonObject::JsonObject(const JsonObject& other) : node_(std::make_unique<Node>(*other.node_)) {}
JsonObject::JsonObject(JsonObject&& other) noexcept = default;
JsonObject& JsonObject::operator=(JsonObject other) noexcept {
  node_ = std::move(other.node_);
  return *this;
}
JsonObject::~JsonObject() = default;

JsonObject& JsonObject::set(std::string_view key, double value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, std::int64_t value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, bool value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, std::string_view value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const std::optional<double>& value) {
  node_->json[std::string(key)] = value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const Vector3d& value) {
  return set(key, std::vector<double>(value.data(), value.data() + value.size()));
}
JsonObject& JsonObject::set(std::string_view key, const Matrix3d& value) {
  auto rows = nlohmann::ordered_json::array();
  for (Eigen::Index row = 0; row < 3; ++row) rows.push_back({value(row, 0), value(row, 1), value(row, 2)});
  node_->json[std::string(key)] = std::move(rows);
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const std::vector<double>& value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const std::vector<std::int64_t>& value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const std::vector<std::string>& value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const std::vector<std::vector<double>>& value) {
  node_->json[std::string(key)] = value;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const JsonObject& value) {
  node_->json[std::string(key)] = value.node_->json;
  return *this;
}
JsonObject& JsonObject::set(std::string_view key, const std::vector<JsonObject>& value) {
  auto array = nlohmann::ordered_json::array();
  for (const JsonObject& object : value) array.push_back(object.node_->json);
  node_->json[std::string(key)] = std::move(array);
  return *this;
}

std::string JsonObject::text() const {
  return node_->json.dump(kIndent, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

JsonObject begin_document(std::string_view schema, const JsonContext& context) {
  JsonObject document;
  return document.set("schema", schema).set("version", context.version);
}

void end_document(JsonObject& document, const JsonContext& context, const Diagnostics& own) {
  Diagnostics all = context.diagnostics;
  all.merge(own);
  set_inputs(document, context.inputs);
  std::vector<JsonObject> examples;
  for (const Diagnostic& diagnostic : all.examples()) examples.push_back(to_json(diagnostic));
  document.set("diagnostics", examples).set("diagnostic_counts", to_json(all.counts()));
}

}  // namespace vispline
