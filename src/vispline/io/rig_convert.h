/// Between the calibration of other tools and a rig of ours. docs/formats.md, Rigs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vispline/calibration/rig_calibration.h"
#include "vispline/core/error.h"
#include "vispline/sensors/rig.h"

namespace vispline {

/// The camera without its place in the body, which needs the rest of the rig. Precondition: model, distortion and
/// numbers are possible (rig_checks.h). The rate, which such files do not hold, stays, or is what leaves time to read
/// the image. Throws E-CONFIG for a pair of model and distortion that no lens of ours has.
Camera camera_of(const CameraCalibration& camera);

/// What a noise file says; a walk without a value is its upper bound, else 0.
ImuNoise imu_noise_of(const ImuNoiseEntry& entry);

/// A rig whose body is that of T_i_b, the first IMU in the files of most tools. W-CONFIG for a camera whose place is
/// unknown: it is put into the origin of the body. `where` is for messages.
Rig rig_of(const RigCalibration& calibration, const std::string& where, Diagnostics& diagnostics);

/// The other way; what does not fit is told in `notes`. The frame of an IMU is that of its accelerometer.
RigCalibration calibration_of(const Rig& rig, std::vector<std::string>& notes);

/// Camera model and distortion in Kalibr's words.
struct LensWords {
  std::string_view model;
  std::string_view distortion_model;
};
LensWords lens_words(LensModel model);

}  // namespace vispline
