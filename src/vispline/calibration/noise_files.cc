#include "vispline/calibration/noise_files.h"

#include <cmath>

#include "vispline/calibration/basalt_noise.h"
#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/imu_utils_noise.h"
#include "vispline/calibration/kalibr_noise.h"
#include "vispline/calibration/openvins_noise.h"
#include "vispline/calibration/orbslam3_noise.h"
#include "vispline/calibration/vins_fusion_noise.h"
#include "vispline/core/error.h"

namespace vispline {
namespace {

using Tables = std::optional<ImuUtilsTables>;

struct Dialect {
  const char* name;
  NamedText (*write)(const ImuNoiseEntry&, const Tables&);
};

template <NamedText (*kWrite)(const ImuNoiseEntry&)>
NamedText without_tables(const ImuNoiseEntry& entry, const Tables&) {
  return kWrite(entry);
}

constexpr Dialect kDialects[] = {
    {kalibr_noise::kName, without_tables<kalibr_noise::write>},
    {openvins_noise::kName, without_tables<openvins_noise::write>},
    {vins_fusion_noise::kName, without_tables<vins_fusion_noise::write>},
    {orbslam3_noise::kName, without_tables<orbslam3_noise::write>},
    {basalt_noise::kName, without_tables<basalt_noise::write>},
    {imu_utils_noise::kName, imu_utils_noise::write},
};

[[noreturn]] void fail(const std::string& message, const std::string& next) {
  throw Error(ExitCode::kUsage,
              {.code = "E-CONFIG", .message = message, .where = "", .effect = "nothing written", .next = next});
}

void require_positive(double value, const std::string& name) {
  if (std::isfinite(value) && value > 0.0) return;
  fail(name + " is " + dialect::brief(value) + ", expected a positive number", "");
}

void require_walk(const WalkEntry& walk, const std::string& name) {
  if (walk.value) require_positive(*walk.value, name);
  if (walk.upper_bound) require_positive(*walk.upper_bound, "the upper bound of " + name);
}

void require_figures(const ImuUtilsTriad& triad, const std::string& name) {
  for (const ImuUtilsFigure& figure : {triad.average, triad.axis[0], triad.axis[1], triad.axis[2]}) {
    require_positive(figure.n, name + "_n");
    if (figure.w) require_positive(*figure.w, name + "_w");
  }
}

void require_valid(const ImuNoiseEntry& entry, const Tables& tables) {
  require_positive(entry.gyro_white, "the white noise of the gyroscope");
  require_positive(entry.accel_white, "the white noise of the accelerometer");
  require_positive(entry.rate_hz, "the rate");
  require_walk(entry.gyro_walk, "the random walk of the gyroscope");
  require_walk(entry.accel_walk, "the random walk of the accelerometer");
  if (!tables) return;
  require_figures(tables->gyro, "gyr");
  require_figures(tables->accel, "acc");
}

}  // namespace

std::vector<std::string> noise_dialects() {
  std::vector<std::string> names;
  for (const Dialect& row : kDialects) names.emplace_back(row.name);
  return names;
}

NamedText noise_file(std::string_view dialect, const ImuNoiseEntry& entry, const Tables& tables) {
  for (const Dialect& row : kDialects) {
    if (dialect != row.name) continue;
    require_valid(entry, tables);
    return row.write(entry, tables);
  }
  std::string known;
  for (const std::string& name : noise_dialects()) known += (known.empty() ? "" : ", ") + name;
  fail("unknown kind of parameter file " + vispline::quoted(dialect), "choose one of: " + known);
}

}  // namespace vispline
