#include "vispline/io/rig_yaml_blocks.h"

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/rig_checks.h"
#include "vispline/calibration/rig_text.h"

namespace vispline::rig_yaml {
using namespace dialect;
namespace {

template <class Vector>
void read_list(ConfigMap& map, std::string_view key, std::string_view unit, Vector& value) {
  const std::vector<double> numbers = map.numbers(key, static_cast<std::size_t>(value.size()), unit);
  value = Eigen::Map<const Vector>(numbers.data());
}

template <class Vector>
std::string list_line(const std::string& indent, const Block& block, const Vector& value) {
  return value_line(indent, block.name, list({value.data(), value.data() + value.size()}), block.unit);
}

}  // namespace

void read_block(ConfigMap& map, std::string_view key, std::string_view unit, double& value) {
  value = map.number(key, unit);
}
void read_block(ConfigMap& map, std::string_view key, std::string_view unit, Vector3d& value) {
  read_list(map, key, unit, value);
}
void read_block(ConfigMap& map, std::string_view key, std::string_view unit, Vector6<double>& value) {
  read_list(map, key, unit, value);
}
void read_block(ConfigMap& map, std::string_view key, std::string_view unit, Matrix3d& value) {
  value = rig_checks::read_matrix3(map, key, unit);
}
void read_block(ConfigMap& map, std::string_view key, std::string_view, Pose& value) {
  value = rig_checks::read_pose(map, key);
}

std::string block_line(const std::string& indent, const Block& block, double value) {
  return value_line(indent, block.name, yaml_float(value), block.unit);
}
std::string block_line(const std::string& indent, const Block& block, const Vector3d& value) {
  return list_line(indent, block, value);
}
std::string block_line(const std::string& indent, const Block& block, const Vector6<double>& value) {
  return list_line(indent, block, value);
}
std::string block_line(const std::string& indent, const Block& block, const Matrix3d& value) {
  return rows(indent, std::string(block.name), value, std::string(block.unit));
}
std::string block_line(const std::string& indent, const Block& block, const Pose& value) {
  return rows(indent, std::string(block.name), matrix4(value), "instrument to body, m");
}

}  // namespace vispline::rig_yaml
