/// The events of yaml-cpp to a tree, with every limit checked before memory is taken.
#pragma once

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vispline/calibration/yaml.h"

namespace vispline {

class YamlTreeBuilder : public YAML::EventHandler {
 public:
  /// Errors name places in `file`, which must outlive the builder.
  explicit YamlTreeBuilder(const YamlFile& file) : file_(file) {}
  /// The root, once the document has ended.
  YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { close(); }

 private:
  struct Anchored {
    YamlNode node;
    std::size_t nodes = 0;   ///< in it
    std::size_t height = 0;  ///< levels below it
  };
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = 0;
    std::size_t nodes_before = 0;
    std::size_t height = 0;
    std::optional<YamlKey> key{};  ///< of a map: waits for its value
  };

  void check_tag(const YAML::Mark& mark, const std::string& tag, bool is_map) const;
  void count_node(YamlPlace place);
  void open(YamlNode node, YAML::anchor_t anchor);
  void close();
  void place_node(YamlNode node, std::size_t height);
  void take_key(Open& map, const YamlNode& node) const;
  void remember(YAML::anchor_t anchor, const YamlNode& node, std::size_t nodes, std::size_t height);

  const YamlFile& file_;
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
  std::size_t alias_nodes_ = 0;
};

}  // namespace vispline
