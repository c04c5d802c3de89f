#include "vispline/calibration/openvins_noise.h"

#include "vispline/calibration/config_map.h"
#include "vispline/calibration/kalibr_noise.h"
#include "vispline/calibration/rig_dialects.h"

namespace vispline::openvins_noise {

NamedText write(const ImuNoiseEntry& entry) { return openvins_rig::imu_chain({.noise = entry}); }

bool recognizes(const YamlFile& file) {
  const YamlNode* imu = file.root.find("imu0");
  return imu && (file.is_opencv || imu->find("Tw") || imu->find("R_IMUtoGYRO"));
}

NoiseReading read(const YamlFile& file, const NoiseReadOptions&) {
  NoiseReading reading{.dialect = kName};
  ConfigMap root(file, file.root, "", reading.diagnostics);
  ConfigMap imu = root.map("imu0");
  imu.accept_all({"T_i_b", "time_offset", "model", "Tw", "R_IMUtoGYRO", "Ta", "R_IMUtoACC", "Tg"});
  reading.entry = kalibr_noise::read_figures(imu);
  imu.warn_unknown();
  root.warn_unknown();
  return reading;
}

}  // namespace vispline::openvins_noise
