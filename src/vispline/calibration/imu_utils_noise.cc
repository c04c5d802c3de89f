#include "vispline/calibration/imu_utils_noise.h"

#include <cmath>
#include <numbers>

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/imu_utils_explanation.h"

namespace vispline::imu_utils_noise {
using namespace dialect;
namespace {

constexpr const char* kAxes[] = {"x-axis", "y-axis", "z-axis"};

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
  for (std::size_t i = 0; i < 3; ++i) lines += figure_lines(text, kAxes[i], triad.axis[i], notes);
  return lines;
}

ImuUtilsFigure read_figure(ConfigMap axis, const std::string& key, const char* unit) {
  ImuUtilsFigure figure{.n = axis.number_or_nan(key + "_n", unit)};
  if (axis.has(key + "_w")) figure.w = axis.number_or_nan(key + "_w", unit);
  axis.warn_unknown();
  return figure;
}

ImuUtilsTriad read_triad(ConfigMap& map, const std::string& key, const char* unit) {
  map.accept("unit");
  ImuUtilsTriad triad{.average = read_figure(map.map("avg-axis"), key, unit)};
  for (std::size_t i = 0; i < 3; ++i) triad.axis[i] = read_figure(map.map(kAxes[i]), key, unit);
  map.warn_unknown();
  return triad;
}

/// N and the bound of K of the average axis, in the way of reading n that `meaning` calls likely.
double white_of(ConfigMap& root, const char* key, const ImuUtilsAxisMeaning& average, bool n_is_density,
                const char* unit) {
  const auto& reading = n_is_density ? average.as_density : average.as_sigma;
  if (!reading) root.fail(key, "holds a noise of " + brief(average.figure.n) + ", expected a positive number");
  return plausible(root, key, reading->white, unit);
}

WalkEntry walk_of(ConfigMap& root, const char* title, const std::string& key, const ImuUtilsAxisMeaning& average,
                  bool n_is_density) {
  const auto& reading = n_is_density ? average.as_density : average.as_sigma;
  if (!reading->walk) {
    root.warn(title, "has no " + key + "_w that says anything about the random walk");
    return {};
  }
  root.warn(title, "holds " + key +
                       "_w, the minimum of the Allan deviation and not the random walk; it bounds the random walk from "
                       "above");
  return {.upper_bound = reading->walk};
}

}  // namespace

bool is_saturated(double w, double saturation) { return std::abs(w / saturation - 1.0) < 1e-4; }

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

bool recognizes(const YamlFile& file) { return file.root.find("Gyr") && file.root.find("Acc"); }

ImuUtilsTables read_tables(const YamlFile& file, Diagnostics& diagnostics) {
  ConfigMap root(file, file.root, "", diagnostics);
  root.accept_all({"type", "name"});
  ConfigMap gyro = root.map("Gyr"), accel = root.map("Acc");
  const ImuUtilsTables tables{.gyro = read_triad(gyro, "gyr", "rad/s"), .accel = read_triad(accel, "acc", "m/s^2")};
  root.warn_unknown();
  return tables;
}

std::string read_name(const YamlFile& file, Diagnostics& diagnostics) {
  return ConfigMap(file, file.root, "", diagnostics).text_or("name", "imu");
}

NoiseReading read(const YamlFile& file, const NoiseReadOptions& options) {
  NoiseReading reading{.dialect = kName};
  ConfigMap root(file, file.root, "", reading.diagnostics);
  reading.tables = read_tables(file, reading.diagnostics);
  ImuNoiseEntry& entry = reading.entry;
  entry.rate_hz = required_rate(root, "Gyr", options);
  entry.name = read_name(file, reading.diagnostics);
  const ImuUtilsExplanation meaning = explain_imu_utils(*reading.tables, entry.rate_hz);
  const ImuUtilsAxisMeaning &gyro = meaning.gyro.axes[0], &accel = meaning.accel.axes[0];
  const bool density = meaning.density_is_likely;
  if (density)
    root.warn("Gyr", "and Acc hold densities, as first versions of imu_utils wrote them: not divided by sqrt(rate)");
  entry.gyro_white = white_of(root, "Gyr", gyro, density, kGyroWhiteUnit);
  entry.accel_white = white_of(root, "Acc", accel, density, kAccelWhiteUnit);
  entry.gyro_walk = walk_of(root, "Gyr", "gyr", gyro, density);
  entry.accel_walk = walk_of(root, "Acc", "acc", accel, density);
  return reading;
}

}  // namespace vispline::imu_utils_noise
