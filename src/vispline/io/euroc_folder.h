/// The small files of a EuRoC folder: sensor.yaml of IMUs and cameras, the list of images. docs/formats.md.
#pragma once

#include <string>

#include "vispline/core/time.h"
#include "vispline/sensors/rig.h"

namespace vispline::euroc_folder {

/// mav0/imu0/sensor.yaml
std::string imu_yaml(const Imu& imu);
/// mav0/cam0/sensor.yaml; lenses other than pinhole with radtan or equidistant under Kalibr's words.
std::string camera_yaml(const Camera& camera);

inline constexpr const char* kImageHeader = "#timestamp [ns],filename\n";
/// A row of mav0/cam0/data.csv.
std::string image_row(Time stamp);
/// 1403636579763555584.png
std::string image_name(Time stamp);

}  // namespace vispline::euroc_folder
