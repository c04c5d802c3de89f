#include "vispline/calibration/read_noise.h"

#include "vispline/calibration/basalt_noise.h"
#include "vispline/calibration/imu_utils_noise.h"
#include "vispline/calibration/kalibr_noise.h"
#include "vispline/calibration/openvins_noise.h"
#include "vispline/calibration/orbslam3_noise.h"
#include "vispline/calibration/vins_fusion_noise.h"
#include "vispline/calibration/yaml_error.h"

namespace vispline {
namespace {

struct Reader {
  const char* name;
  bool (*recognizes)(const YamlFile&);
  NoiseReading (*read)(const YamlFile&, const NoiseReadOptions&);
};

/// The more special first.
constexpr Reader kReaders[] = {
    {imu_utils_noise::kName, imu_utils_noise::recognizes, imu_utils_noise::read},
    {basalt_noise::kName, basalt_noise::recognizes, basalt_noise::read},
    {orbslam3_noise::kName, orbslam3_noise::recognizes, orbslam3_noise::read},
    {vins_fusion_noise::kName, vins_fusion_noise::recognizes, vins_fusion_noise::read},
    {openvins_noise::kName, openvins_noise::recognizes, openvins_noise::read},
    {kalibr_noise::kName, kalibr_noise::recognizes, kalibr_noise::read},
};

const Reader& reader_of(const YamlFile& file) {
  for (const Reader& reader : kReaders) {
    if (reader.recognizes(file)) return reader;
  }
  std::string known;
  for (const std::string& name : noise_dialects()) known += (known.empty() ? "" : ", ") + name;
  fail_config("no noise figures of an IMU in the file", file.path, "it can be a file of: " + known);
}

NoiseReading read(const YamlFile& file, const NoiseReadOptions& options) { return reader_of(file).read(file, options); }

}  // namespace

std::string noise_dialect_of(const YamlFile& file) { return reader_of(file).name; }

NoiseReading parse_noise(std::string path, std::string_view text, const NoiseReadOptions& options) {
  return read(parse_yaml(std::move(path), text), options);
}

NoiseReading read_noise_file(const std::string& path, const NoiseReadOptions& options) {
  return read(read_yaml(path), options);
}

}  // namespace vispline
