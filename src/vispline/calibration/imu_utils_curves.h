/// The Allan curves as the text files of imu_utils, which its plotting scripts read.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/calibration/noise_entry.h"

namespace vispline {

/// Allan deviations of the axes x, y, z and of a model fitted to them, at `tau_s` seconds. rad/s or m/s^2.
struct AllanTriadCurve {
  std::vector<double> tau_s;
  std::array<std::vector<double>, 3> deviation;
  std::array<std::vector<double>, 3> fitted;
};

/// The 16 files data_NAME_{gyr,acc,sim_gyr,sim_acc}_{t,x,y,z}.txt: one number a line, ten significant digits; the
/// gyroscope in deg/h, the accelerometer in m/s^2, t in s, "sim" is the fitted curve. Throws E-ARGUMENT if the columns
/// of a triad differ in length.
std::vector<NamedText> imu_utils_curves(std::string_view name, const AllanTriadCurve& gyro,
                                        const AllanTriadCurve& accel);

}  // namespace vispline
