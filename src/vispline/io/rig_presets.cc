#include "vispline/io/rig_presets.h"

#include <Eigen/Geometry>

#include "vispline/core/so3.h"
#include "vispline/io/course_files.h"

namespace vispline {
namespace {

/// Looks along x of the body, which turns by `rotation_b` rad (small), from p_b_c.
Pose ahead(const Vector3d& p_b_c, const Vector3d& rotation_b = Vector3d::Zero()) {
  Pose T_b_c;
  T_b_c.R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_b_c.R = SO3::exp<double>(rotation_b) * T_b_c.R;
  T_b_c.p = p_b_c;
  return T_b_c.inverse();
}

Lens lens(LensModel model, std::initializer_list<double> params) {
  Lens lens{.model = model};
  lens.params = Eigen::Map<const Eigen::VectorXd>(params.begin(), static_cast<Eigen::Index>(params.size()));
  return lens;
}

/// Constants of vio_data_simulation.
RigDocument course() {
  RigDocument document;
  Imu imu{.name = "imu0", .rate_hz = 200.0};
  imu.noise = {.gyro = {.white = 0.015, .walk = 1e-5}, .accel = {.white = 0.019, .walk = 1e-4}};
  document.rig.imus = {imu};
  document.rig.cameras = {{.name = "cam0",
                           .rate_hz = 30.0,
                           .resolution_px = {640, 640},
                           .lens = lens(LensModel::kPinhole, {460.0, 460.0, 255.0, 255.0}),
                           .T_c_b = course_T_b_c().inverse()}};
  return document;
}

/// Two global shutters 11 cm apart with lenses and noise like those of the EuRoC recordings (Burri et al., IJRR 2016,
/// sensor.yaml of their data).
RigDocument euroc_stereo() {
  RigDocument document;
  Imu imu{.name = "imu0", .rate_hz = 200.0};
  imu.noise = {.gyro = {.white = 1.6968e-4, .walk = 1.9393e-5, .turn_on_bias = 0.02},
               .accel = {.white = 2.0e-3, .walk = 3.0e-3, .turn_on_bias = 0.05}};
  document.rig.imus = {imu};
  const Lens left = lens(LensModel::kPinholeRadtan,
                         {458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
  const Lens right = lens(LensModel::kPinholeRadtan,
                          {457.587, 456.134, 379.999, 255.238, -0.28368365, 0.07451284, -0.00010473, -3.55590700e-05});
  document.rig.cameras = {{.name = "cam0",
                           .rate_hz = 20.0,
                           .resolution_px = {752, 480},
                           .lens = left,
                           .T_c_b = ahead({0.01, 0.065, -0.02}, {0.015, -0.01, 0.004}),
                           .shutter = {.exposure_s = 0.005}},
                          {.name = "cam1",
                           .rate_hz = 20.0,
                           .resolution_px = {752, 480},
                           .lens = right,
                           .T_c_b = ahead({0.008, -0.045, -0.02}, {0.013, -0.024, -0.01}),
                           .shutter = {.exposure_s = 0.005}}};
  document.clocks = {{"cam0", {.phase_s = 0.01}}, {"cam1", {.phase_s = 0.01}}};
  return document;
}

/// One rolling shutter read in 30 ms, a cheap IMU whose clock is 5 ms apart and not quite as fast.
RigDocument phone() {
  RigDocument document;
  Imu imu{.name = "imu0", .rate_hz = 200.0};
  imu.noise = {.gyro = {1.2e-4, 2e-5, 3e-5, 0.01, 0.0, 34.9}, .accel = {1.8e-3, 5e-4, 4e-4, 0.1, 0.0, 78.5}};
  imu.gyroscope.scale = Vector3d(0.004, -0.003, 0.002);
  imu.accelerometer.scale = Vector3d(-0.006, 0.004, 0.008);
  imu.accelerometer.misalignment << 0.002, -0.001, 0.0, 0.0015, 0.0, 0.0;
  document.rig.imus = {imu};
  constexpr int kLines = 480;
  document.rig.cameras = {
      {.name = "cam0",
       .rate_hz = 30.0,
       .resolution_px = {640, kLines},
       .lens = lens(LensModel::kPinholeRadtan, {502.1, 501.4, 318.6, 241.9, 0.08, -0.16, 0.0004, -0.0003}),
       .T_c_b = ahead({0.004, 0.052, 0.011}, {0.01, 0.02, -0.015}),
       .time_offset_s = 0.005,
       .shutter = {.line_delay_s = 0.030 / kLines, .exposure_s = 0.008}}};
  document.clocks["cam0"] = {.phase_s = 0.0123};
  return document;
}

/// A wide fisheye at 60 Hz whose shutter is read in 13 ms.
RigDocument gopro() {
  RigDocument document;
  Imu imu{.name = "imu0", .rate_hz = 200.0};
  imu.noise = {.gyro = {1.5e-4, 3e-5, 4e-5, 0.01, 0.0, 34.9}, .accel = {2.0e-3, 6e-4, 5e-4, 0.1, 0.0, 156.9}};
  document.rig.imus = {imu};
  constexpr int kLines = 720;
  document.rig.cameras = {
      {.name = "cam0",
       .rate_hz = 60.0,
       .resolution_px = {960, kLines},
       .lens = lens(LensModel::kPinholeEquidistant, {440.7, 440.9, 479.8, 360.2, 0.035, 0.012, -0.009, 0.001}),
       .T_c_b = ahead({0.012, 0.018, 0.005}, {-0.01, 0.005, 0.02}),
       .time_offset_s = -0.008,
       .shutter = {.line_delay_s = 0.013 / kLines, .exposure_s = 0.004}}};
  document.clocks["cam0"] = {.phase_s = 0.0231};
  return document;
}

struct Preset {
  const char* name;
  RigDocument (*make)();
};
constexpr Preset kPresets[] = {{"course", course}, {"euroc-stereo", euroc_stereo}, {"phone", phone}, {"gopro", gopro}};

}  // namespace

std::vector<std::string> rig_preset_names() {
  std::vector<std::string> names;
  for (const Preset& preset : kPresets) names.emplace_back(preset.name);
  return names;
}

std::optional<RigDocument> rig_preset(std::string_view name) {
  for (const Preset& preset : kPresets) {
    if (name == preset.name) return preset.make();
  }
  return std::nullopt;
}

}  // namespace vispline
