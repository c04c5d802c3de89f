/// Calibration boards: target.yaml of Kalibr and the JSON of Basalt. docs/calibration-files.md.
#pragma once

#include <string>
#include <string_view>

#include "vispline/calibration/noise_entry.h"
#include "vispline/core/error.h"

namespace vispline {

enum class TargetKind { kAprilgrid, kCheckerboard, kCirclegrid };

struct TargetCalibration {
  TargetKind kind = TargetKind::kAprilgrid;
  int cols = 0;                ///< tags, inner corners or circles along x
  int rows = 0;                ///< along y
  double tag_size_m = 0.0;     ///< edge of a tag, black border included; aprilgrid only
  double tag_spacing = 0.0;    ///< gap between tags divided by tag_size_m; aprilgrid only
  double col_spacing_m = 0.0;  ///< checkerboard: width of a square; circlegrid: distance of circles
  double row_spacing_m = 0.0;  ///< checkerboard: height of a square; circlegrid: equal to col_spacing_m
  bool is_asymmetric = false;  ///< circlegrid only
};

struct TargetReading {
  TargetCalibration target{};
  Diagnostics diagnostics{};
};

/// Throws what parse_yaml throws and E-CONFIG (exit 2). A file without target_type is an aprilgrid, as Basalt writes
/// it.
TargetReading parse_target(std::string path, std::string_view text);
TargetReading read_target_file(const std::string& path);

/// `dialect`: "kalibr", or "basalt", which knows aprilgrids only. Throws E-CONFIG (exit 2) for another one and for a
/// target without rows, columns or size.
NamedText target_file(std::string_view dialect, const TargetCalibration& target);

}  // namespace vispline
