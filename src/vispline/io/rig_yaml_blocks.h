/// The parameter blocks of a sensor as YAML: the keys are the names in kBlocks. docs/formats.md, Rigs.
#pragma once

#include <string>
#include <tuple>
#include <utility>

#include "vispline/calibration/config_map.h"
#include "vispline/core/pose.h"
#include "vispline/sensors/sensor.h"

namespace vispline::rig_yaml {

void read_block(ConfigMap& map, std::string_view key, std::string_view unit, double& value);
void read_block(ConfigMap& map, std::string_view key, std::string_view unit, Vector3d& value);
void read_block(ConfigMap& map, std::string_view key, std::string_view unit, Vector6<double>& value);
void read_block(ConfigMap& map, std::string_view key, std::string_view unit, Matrix3d& value);
void read_block(ConfigMap& map, std::string_view key, std::string_view unit, Pose& value);

std::string block_line(const std::string& indent, const Block& block, double value);
std::string block_line(const std::string& indent, const Block& block, const Vector3d& value);
std::string block_line(const std::string& indent, const Block& block, const Vector6<double>& value);
std::string block_line(const std::string& indent, const Block& block, const Matrix3d& value);
std::string block_line(const std::string& indent, const Block& block, const Pose& value);

/// Each block that the map has; the others stay.
template <Sensor Model>
void read_blocks(ConfigMap& map, typename Model::template Params<double>& params) {
  const auto blocks = params.tie();
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((map.has(Model::kBlocks[i].name)
          ? read_block(map, Model::kBlocks[i].name, Model::kBlocks[i].unit, std::get<i>(blocks))
          : void()),
     ...);
  }
  (std::make_index_sequence<Model::kBlocks.size()>());
}

template <Sensor Model>
std::string block_lines(const std::string& indent, const typename Model::template Params<double>& params) {
  std::string text;
  const auto blocks = params.tie();
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((text += block_line(indent, Model::kBlocks[i], std::get<i>(blocks))), ...);
  }
  (std::make_index_sequence<Model::kBlocks.size()>());
  return text;
}

}  // namespace vispline::rig_yaml
