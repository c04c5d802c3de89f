/// A camera on the body: lens, shutter, place and clock. docs/math/camera.md.
#pragma once

#include <array>
#include <string>

#include "vispline/core/pose.h"
#include "vispline/sensors/lens.h"
#include "vispline/sensors/shutter.h"

namespace vispline {

/// Frame c: x right, y down, z forward. Pixel (0, 0) is the centre of the upper left one.
struct Camera {
  std::string name = "cam0";  ///< unique in a rig; also names the camera's random streams
  double rate_hz = 30.0;
  std::array<int, 2> resolution_px{640, 480};  ///< width, height
  Lens lens{};
  Pose T_c_b{};                ///< coordinates in the body to coordinates in the camera; Kalibr's T_cam_imu
  double time_offset_s = 0.0;  ///< t_body = t_camera + time_offset; Kalibr's timeshift_cam_imu
  Shutter shutter{};
  double pixel_sigma_px = 1.0;  ///< standard deviation of a feature, per axis

  /// s from the stamp of a frame to the instant, on the body's clock, at which the line of `px` was exposed:
  ///   time_offset + line_delay * line(px)                                                        docs/math/camera.md
  double delay_s(const Vector2d& px) const {
    return time_offset_s + shutter.line_delay_s * shutter.line(px, resolution_px);
  }
  bool in_image(const Vector2d& px) const {
    return px.x() >= -0.5 && px.y() >= -0.5 && px.x() <= resolution_px[0] - 0.5 && px.y() <= resolution_px[1] - 0.5;
  }
};

/// Throws Error(kUsage, E-CONFIG) with the name of the camera and the field unless name, rate, resolution, lens
/// parameters (finite, focal lengths positive, as many as the model has), pose and shutter make sense.
void require_valid(const Camera& camera);

}  // namespace vispline
