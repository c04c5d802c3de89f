#include "vispline/calibration/imu_utils_curves.h"

#include <charconv>
#include <numbers>

#include "vispline/calibration/dialect_text.h"
#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr double kDegPerHour = 180.0 / std::numbers::pi * 3600.0;

std::string column(const std::vector<double>& values, double factor) {
  std::string text;
  for (const double value : values) {
    char buffer[64];
    text.append(buffer,
                std::to_chars(buffer, buffer + sizeof buffer, factor * value, std::chars_format::general, 10).ptr);
    text += '\n';
  }
  return text;
}

void append_triad(std::vector<NamedText>& files, const std::string& stem, const std::vector<double>& tau_s,
                  const std::array<std::vector<double>, 3>& axes, double factor) {
  files.push_back({.file_name = stem + "_t.txt", .text = column(tau_s, 1.0)});
  for (std::size_t i = 0; i < 3; ++i) {
    require(axes[i].size() == tau_s.size(), "as many deviations as averaging times");
    files.push_back({.file_name = stem + "_" + "xyz"[i] + ".txt", .text = column(axes[i], factor)});
  }
}

}  // namespace

std::vector<NamedText> imu_utils_curves(std::string_view name, const AllanTriadCurve& gyro,
                                        const AllanTriadCurve& accel) {
  const std::string stem = "data_" + dialect::slug(name) + "_";
  std::vector<NamedText> files;
  append_triad(files, stem + "gyr", gyro.tau_s, gyro.deviation, kDegPerHour);
  append_triad(files, stem + "acc", accel.tau_s, accel.deviation, 1.0);
  append_triad(files, stem + "sim_gyr", gyro.tau_s, gyro.fitted, kDegPerHour);
  append_triad(files, stem + "sim_acc", accel.tau_s, accel.fitted, 1.0);
  return files;
}

}  // namespace vispline
