#include "vispline/calibration/yaml_tree_builder.h"

#include <algorithm>
#include <utility>

#include "vispline/calibration/yaml_error.h"

namespace vispline {
namespace {

constexpr const char* kMatrixTag = "tag:yaml.org,2002:opencv-matrix";

YamlPlace place_of(const YAML::Mark& mark) { return {mark.line + 1, mark.column + 1}; }

YamlNode make(YamlNode::Kind kind, const YAML::Mark& mark) { return {.kind = kind, .place = place_of(mark)}; }

}  // namespace

void YamlTreeBuilder::check_tag(const YAML::Mark& mark, const std::string& tag, bool is_map) const {
  if (tag.empty() || tag == "?" || tag == "!") return;
  const std::string where = file_.at(place_of(mark));
  if (tag != kMatrixTag || !is_map) fail_yaml("tag " + vispline::quoted(tag) + ": tags are not read", where);
  if (!file_.is_opencv) fail_yaml("tag !!opencv-matrix in a file that does not start with %YAML:1.0", where);
}

void YamlTreeBuilder::count_node(YamlPlace place) {
  if (++nodes_ <= yaml_limits::kNodes) return;
  fail_yaml_limit("more than " + std::to_string(yaml_limits::kNodes) + " values", file_.at(place));
}

void YamlTreeBuilder::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  count_node(place_of(mark));
  const YamlNode node = make(YamlNode::Kind::kNull, mark);
  remember(anchor, node, 1, 0);
  place_node(node, 0);
}

void YamlTreeBuilder::OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                               const std::string& value) {
  check_tag(mark, tag, false);
  count_node(place_of(mark));
  YamlNode node = make(YamlNode::Kind::kScalar, mark);
  node.text = value;
  node.is_quoted = tag == "!";
  remember(anchor, node, 1, 0);
  place_node(std::move(node), 0);
}

void YamlTreeBuilder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const std::string where = file_.at(place_of(mark));
  const auto found = anchors_.find(anchor);
  if (found == anchors_.end()) fail_yaml_limit("an alias inside the node that it stands for", where);
  const auto& [node, nodes, height] = found->second;
  alias_nodes_ += nodes;
  if (alias_nodes_ > yaml_limits::kAliasNodes) {
    fail_yaml_limit("aliases stand for more than " + std::to_string(yaml_limits::kAliasNodes) + " values", where);
  }
  nodes_ += nodes;
  if (open_.size() + height >= yaml_limits::kDepth) fail_yaml_limit("nested too deep by an alias", where);
  place_node(node, height);
}

void YamlTreeBuilder::OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                                      YAML::EmitterStyle::value) {
  check_tag(mark, tag, false);
  open(make(YamlNode::Kind::kSequence, mark), anchor);
}

void YamlTreeBuilder::OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                                 YAML::EmitterStyle::value) {
  check_tag(mark, tag, true);
  YamlNode node = make(YamlNode::Kind::kMap, mark);
  node.is_opencv_matrix = tag == kMatrixTag;
  open(std::move(node), anchor);
}

void YamlTreeBuilder::open(YamlNode node, YAML::anchor_t anchor) {
  if (open_.size() >= yaml_limits::kDepth) {
    fail_yaml_limit("nested deeper than " + std::to_string(yaml_limits::kDepth) + " levels", file_.at(node.place));
  }
  count_node(node.place);
  open_.push_back({.node = std::move(node), .anchor = anchor, .nodes_before = nodes_ - 1});
}

void YamlTreeBuilder::close() {
  Open done = std::move(open_.back());
  open_.pop_back();
  const std::size_t height = done.height + 1;
  remember(done.anchor, done.node, nodes_ - done.nodes_before, height);
  place_node(std::move(done.node), height);
}

void YamlTreeBuilder::remember(YAML::anchor_t anchor, const YamlNode& node, std::size_t nodes, std::size_t height) {
  if (anchor == 0) return;
  alias_nodes_ += nodes;  // the copy that is kept costs as much as an alias
  if (alias_nodes_ > yaml_limits::kAliasNodes) {
    fail_yaml_limit("anchors hold more than " + std::to_string(yaml_limits::kAliasNodes) + " values",
                    file_.at(node.place));
  }
  anchors_[anchor] = {node, nodes, height};
}

void YamlTreeBuilder::take_key(Open& map, const YamlNode& node) const {
  const std::string where = file_.at(node.place);
  if (node.kind != YamlNode::Kind::kScalar) fail_yaml("a key that is not a word", where);
  if (map.node.keys.size() >= yaml_limits::kMapKeys) {
    fail_yaml_limit("more than " + std::to_string(yaml_limits::kMapKeys) + " keys in one map", where);
  }
  if (map.node.find(node.text) != nullptr) fail_config("key " + vispline::quoted(node.text) + " comes twice", where);
  map.key = YamlKey{node.text, node.place};
}

void YamlTreeBuilder::place_node(YamlNode node, std::size_t height) {
  if (open_.empty()) {
    root_ = std::move(node);
    return;
  }
  Open& parent = open_.back();
  if (parent.node.kind == YamlNode::Kind::kMap && !parent.key) return take_key(parent, node);
  parent.height = std::max(parent.height, height);
  if (parent.key) parent.node.keys.push_back(*std::exchange(parent.key, std::nullopt));
  parent.node.items.push_back(std::move(node));
}

}  // namespace vispline
