#include "vispline/calibration/target_file.h"

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/rig_dialects.h"
#include "vispline/files/small_file.h"

namespace vispline {
using namespace dialect;
namespace {

constexpr int kMostRows = 1000;

void read_aprilgrid(ConfigMap& map, TargetCalibration& target) {
  target.cols = map.integer("tagCols", "", 1, kMostRows);
  target.rows = map.integer("tagRows", "", 1, kMostRows);
  target.tag_size_m = map.positive("tagSize", "m");
  target.tag_spacing = map.positive("tagSpacing", "gap divided by tagSize");
}

void read_grid(ConfigMap& map, TargetCalibration& target) {
  target.cols = map.integer("targetCols", "", 1, kMostRows);
  target.rows = map.integer("targetRows", "", 1, kMostRows);
  if (target.kind == TargetKind::kCheckerboard) {
    target.col_spacing_m = map.positive("colSpacingMeters", "m");
    target.row_spacing_m = map.positive("rowSpacingMeters", "m");
    return;
  }
  target.col_spacing_m = target.row_spacing_m = map.positive("spacingMeters", "m");
  const std::string asymmetric = map.text_or("asymmetricGrid", "false");
  target.is_asymmetric = asymmetric == "true" || asymmetric == "True" || asymmetric == "1";
  if (!target.is_asymmetric && asymmetric != "false" && asymmetric != "False" && asymmetric != "0") {
    map.fail("asymmetricGrid", "is " + vispline::quoted(asymmetric) + ", expected true or false");
  }
}

TargetKind kind_of(ConfigMap& map) {
  const std::string type = map.text_or("target_type", "aprilgrid");
  if (type == "aprilgrid") return TargetKind::kAprilgrid;
  if (type == "checkerboard") return TargetKind::kCheckerboard;
  if (type == "circlegrid") return TargetKind::kCirclegrid;
  map.fail("target_type", "is " + vispline::quoted(type) + ", expected aprilgrid, checkerboard or circlegrid");
}

std::string aprilgrid_text(const TargetCalibration& target) {
  return "target_type: 'aprilgrid'\n" + value_line("", "tagCols", std::to_string(target.cols), "tags") +
         value_line("", "tagRows", std::to_string(target.rows), "tags") +
         value_line("", "tagSize", yaml_float(target.tag_size_m), "m, edge of a tag with its black border") +
         value_line("", "tagSpacing", yaml_float(target.tag_spacing), "gap between tags divided by tagSize");
}

std::string grid_text(const TargetCalibration& target) {
  const bool is_board = target.kind == TargetKind::kCheckerboard;
  const char* unit = is_board ? "inner corners" : "circles";
  std::string text = std::string("target_type: '") + (is_board ? "checkerboard" : "circlegrid") + "'\n";
  text += value_line("", "targetCols", std::to_string(target.cols), unit);
  text += value_line("", "targetRows", std::to_string(target.rows), unit);
  if (is_board) {
    return text + value_line("", "rowSpacingMeters", yaml_float(target.row_spacing_m), "m") +
           value_line("", "colSpacingMeters", yaml_float(target.col_spacing_m), "m");
  }
  return text + value_line("", "spacingMeters", yaml_float(target.col_spacing_m), "m") +
         value_line("", "asymmetricGrid", target.is_asymmetric ? "True" : "False", "");
}

std::string basalt_text(const TargetCalibration& target) {
  return "{\n  \"tagCols\": " + std::to_string(target.cols) + ",\n  \"tagRows\": " + std::to_string(target.rows) +
         ",\n  \"tagSize\": " + yaml_float(target.tag_size_m) +
         ",\n  \"tagSpacing\": " + yaml_float(target.tag_spacing) + "\n}\n";
}

void require_possible(const TargetCalibration& target) {
  const bool is_tags = target.kind == TargetKind::kAprilgrid;
  const bool sized = is_tags ? target.tag_size_m > 0.0 && target.tag_spacing > 0.0
                             : target.col_spacing_m > 0.0 && target.row_spacing_m > 0.0;
  if (target.cols < 1 || target.rows < 1 || !sized) fail_rig("a target without rows, columns or size");
}

}  // namespace

TargetReading parse_target(std::string path, std::string_view text) {
  const YamlFile file = parse_yaml(std::move(path), text);
  TargetReading reading;
  ConfigMap map(file, file.root, "", reading.diagnostics);
  reading.target.kind = kind_of(map);
  if (reading.target.kind == TargetKind::kAprilgrid) {
    read_aprilgrid(map, reading.target);
  } else {
    read_grid(map, reading.target);
  }
  map.warn_unknown();
  return reading;
}

TargetReading read_target_file(const std::string& path) {
  return parse_target(path, read_small_text_file(path, yaml_limits::kBytes));
}

NamedText target_file(std::string_view dialect, const TargetCalibration& target) {
  require_possible(target);
  const bool is_tags = target.kind == TargetKind::kAprilgrid;
  if (dialect == "kalibr") {
    return {
        .file_name = "target.yaml",
        .text = is_tags ? aprilgrid_text(target) : grid_text(target),
        .next_command = "kalibr_calibrate_cameras --target target.yaml --bag FILE.bag --models MODEL --topics TOPIC"};
  }
  if (dialect != "basalt")
    fail_rig("unknown kind of target file " + vispline::quoted(dialect), "choose kalibr or basalt");
  if (!is_tags) fail_rig("Basalt knows aprilgrids only");
  return {.file_name = "aprilgrid.json",
          .text = basalt_text(target),
          .next_command =
              "basalt_calibrate --dataset-path FOLDER --dataset-type bag --aprilgrid aprilgrid.json "
              "--result-path FOLDER --cam-types MODEL"};
}

}  // namespace vispline
