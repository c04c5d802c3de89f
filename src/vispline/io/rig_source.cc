#include "vispline/io/rig_source.h"

#include "vispline/io/rig_convert.h"
#include "vispline/io/rig_file.h"
#include "vispline/io/rig_yaml.h"

namespace vispline {

CalibrationSource read_rig_source(const std::string& path, const std::string& imu_path, const RigReadOptions& options) {
  const std::string file = calibration_file_of(path);
  if (!rig_yaml::recognizes(read_yaml(file))) return read_calibration(file, imu_path, options);
  ReadRig own = read_rig({file}, {.imu_rate_hz = options.rate_hz});
  CalibrationSource source{.paths = {file}};
  source.reading.dialect = rig_yaml::kName;
  source.reading.rig = calibration_of(own.rig, source.notes);
  source.reading.diagnostics = std::move(own.diagnostics);
  if (imu_path.empty()) return source;
  CalibrationSource imu = read_calibration(imu_path, "", options);
  source.paths.push_back(imu_path);
  source.reading.rig.imus = std::move(imu.reading.rig.imus);
  source.reading.diagnostics.merge(imu.reading.diagnostics);
  return source;
}

}  // namespace vispline
