#include "vispline/calibration/imu_utils_noise.h"

#include <cmath>
#include <numbers>

#include "vispline/calibration/dialect_text.h"

namespace vispline::imu_utils_noise {
using namespace dialect;
namespace {

ImuUtilsTriad triad_from(double white, const WalkEntry& walk, double rate_hz) {
  ImuUtilsFigure figure{.n = white * std::sqrt(rate_hz)};
  if (const auto k = written_walk(walk)) figure.w = std::sqrt(2.0 * white * *k / std::numbers::sqrt3);
  return {.axis = {figure, figure, figure}, .average = figure};
}

struct TriadText {
  std::string title, key, unit;
  double rate_hz = 0.0;
  bool w_is_bound = false;  ///< follows from an upper bound of K
};

std::string figure_lines(const TriadText& text, const char* axis, const ImuUtilsFigure& figure,
                         std::vector<std::string>& notes) {
  std::string lines = std::string("   ") + axis + ":\n";
  lines += value_line("      ", text.key + "_n", opencv_float(figure.n),
                      text.unit + ", standard deviation of one sample at " + brief(text.rate_hz) + " Hz");
  if (figure.w) {
    const std::string bound = text.w_is_bound ? ", upper bound" : "";
    return lines + value_line("      ", text.key + "_w", opencv_float(*figure.w),
                              text.unit + ", minimum of the fitted Allan deviation" + bound);
  }
  notes.push_back(text.title + " " + axis + " " + text.key +
                  "_w is left out: the record does not resolve the random walk");
  return lines + "      # " + text.key + "_w: the record does not resolve the random walk, " + text.unit + "\n";
}

std::string triad_lines(const TriadText& text, const ImuUtilsTriad& triad, std::vector<std::string>& notes) {
  if (text.w_is_bound && triad.average.w) {
    notes.push_back(text.key + "_w is an upper bound: the record does not resolve the random walk");
  }
  std::string lines = text.title + ":\n   unit: \" " + text.unit + "\"\n";
  lines += figure_lines(text, "avg-axis", triad.average, notes);
  static constexpr const char* kAxes[] = {"x-axis", "y-axis", "z-axis"};
  for (std::size_t i = 0; i < 3; ++i) lines += figure_lines(text, kAxes[i], triad.axis[i], notes);
  return lines;
}

}  // namespace

ImuUtilsTables tables_from(const ImuNoiseEntry& entry) {
  return {.gyro = triad_from(entry.gyro_white, entry.gyro_walk, entry.rate_hz),
          .accel = triad_from(entry.accel_white, entry.accel_walk, entry.rate_hz)};
}

NamedText write(const ImuNoiseEntry& entry, const std::optional<ImuUtilsTables>& tables) {
  const std::string name = slug(entry.name);
  NamedText file{.file_name = name + "_imu_param.yaml", .text = "%YAML:1.0\n---\ntype: IMU\n"};
  file.text += value_line("", "name", yaml_string(entry.name), "");
  const ImuUtilsTables figures = tables ? *tables : tables_from(entry);
  const bool derived = !tables;
  file.text +=
      triad_lines({"Gyr", "gyr", "rad/s", entry.rate_hz, derived && !entry.gyro_walk.value}, figures.gyro, file.notes);
  file.text += triad_lines({"Acc", "acc", "m/s^2", entry.rate_hz, derived && !entry.accel_walk.value}, figures.accel,
                           file.notes);
  file.next_command = "vispline allan --explain " + file.file_name + " --rate " + brief(entry.rate_hz);
  return file;
}

}  // namespace vispline::imu_utils_noise
