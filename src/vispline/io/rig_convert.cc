#include "vispline/io/rig_convert.h"

#include <algorithm>

#include "vispline/calibration/dialect_text.h"

namespace vispline {
namespace {

struct LensRow {
  LensModel lens;
  LensWords words;
};

constexpr LensRow kLenses[] = {
    {LensModel::kPinhole, {"pinhole", "none"}},
    {LensModel::kPinholeRadtan, {"pinhole", "radtan"}},
    {LensModel::kPinholeEquidistant, {"pinhole", "equidistant"}},
    {LensModel::kPinholeFov, {"pinhole", "fov"}},
    {LensModel::kOmni, {"omni", "none"}},
    {LensModel::kOmniRadtan, {"omni", "radtan"}},
    {LensModel::kDoubleSphere, {"ds", "none"}},
    {LensModel::kExtendedUnified, {"eucm", "none"}},
};

NoiseModel noise_of(double white, const WalkEntry& walk) {
  return {.white = white, .walk = dialect::written_walk(walk).value_or(0.0)};
}

/// No walk at all is none that other tools could hold: they divide by it.
WalkEntry walk_of(double walk) { return walk > 0.0 ? WalkEntry{.value = walk} : WalkEntry{}; }

/// The parts of M = I + diag(scale) + misalignment, sensors/triad.h.
template <class Params>
void set_triad(const Matrix3d& M, Params& params) {
  params.scale = M.diagonal() - Vector3d::Ones();
  params.misalignment << M(0, 1), M(0, 2), M(1, 0), M(1, 2), M(2, 0), M(2, 1);
}

Imu imu_of(const ImuCalibration& calibration) {
  Imu imu{.name = calibration.noise.name, .noise = imu_noise_of(calibration.noise)};
  if (calibration.noise.rate_hz > 0.0) imu.rate_hz = calibration.noise.rate_hz;
  const Pose T_b_i = calibration.T_i_b.inverse();
  imu.gyroscope.T_b_i = {T_b_i.R * calibration.R_gyro_imu.transpose(), T_b_i.p};
  imu.accelerometer.T_b_i = {T_b_i.R * calibration.R_accel_imu.transpose(), T_b_i.p};
  set_triad(calibration.gyro_M, imu.gyroscope);
  set_triad(calibration.accel_M, imu.accelerometer);
  imu.gyroscope.g_sensitivity = calibration.gyro_A;
  imu.gyroscope.time_offset_s = imu.accelerometer.time_offset_s = calibration.time_offset;
  return imu;
}

ImuCalibration calibration_of(const Imu& imu, std::vector<std::string>& notes) {
  const auto& gyro = imu.gyroscope;
  const auto& accel = imu.accelerometer;
  if (gyro.T_b_i.p != accel.T_b_i.p) notes.push_back(imu.name + ": the place of its gyroscope is lost");
  if (gyro.time_offset_s != accel.time_offset_s) {
    notes.push_back(imu.name + ": the time offset of its gyroscope, " + dialect::brief(gyro.time_offset_s) +
                    " s, stands for both triads");
  }
  if (imu.noise.gyro.walk <= 0.0 || imu.noise.accel.walk <= 0.0) {
    notes.push_back(imu.name + ": a random walk of 0 is left out; set it by hand for tools that ask for one");
  }
  if (!gyro.bias.isZero(0.0) || !accel.bias.isZero(0.0)) notes.push_back(imu.name + ": its biases are lost");
  ImuCalibration calibration{.T_i_b = accel.T_b_i.inverse(), .time_offset = gyro.time_offset_s};
  calibration.noise = {.gyro_white = imu.noise.gyro.white,
                       .accel_white = imu.noise.accel.white,
                       .gyro_walk = walk_of(imu.noise.gyro.walk),
                       .accel_walk = walk_of(imu.noise.accel.walk),
                       .rate_hz = imu.rate_hz,
                       .topic = "/" + imu.name,
                       .name = imu.name};
  const Matrix3d R_gyro_accel = gyro.T_b_i.R.transpose() * accel.T_b_i.R;
  if (gyro.T_b_i.R != accel.T_b_i.R) calibration.R_gyro_imu = R_gyro_accel;
  calibration.gyro_M = triad_matrix(gyro.scale, gyro.misalignment);
  calibration.accel_M = triad_matrix(accel.scale, accel.misalignment);
  calibration.gyro_A = gyro.g_sensitivity;
  return calibration;
}

CameraCalibration calibration_of(const Camera& camera) {
  const auto [model, distortion_model] = lens_words(camera.lens.model);
  CameraCalibration calibration{.name = camera.name,
                                .model = std::string(model),
                                .distortion_model = std::string(distortion_model),
                                .resolution_px = camera.resolution_px};
  const Eigen::Index intrinsics = model == "pinhole" ? 4 : model == "omni" ? 5 : 6;
  const LensParams& params = camera.lens.params;
  calibration.intrinsics.assign(params.data(), params.data() + intrinsics);
  calibration.distortion.assign(params.data() + intrinsics, params.data() + params.size());
  calibration.timeshift_cam_imu = camera.time_offset_s;
  calibration.line_delay = camera.shutter.line_delay_s;
  calibration.topic = "/" + camera.name + "/image_raw";
  return calibration;
}

/// imu_to_camera(), or a place in the chain that starts at the first camera.
Pose place_of(const RigCalibration& rig, std::size_t index, const std::string& where, Diagnostics& diagnostics) {
  if (const auto T_c_i = imu_to_camera(rig, index)) return *T_c_i * (rig.imus.empty() ? Pose{} : rig.imus[0].T_i_b);
  const CameraCalibration& camera = rig.cameras[index];
  if (index > 0 && camera.T_cn_cnm1) return *camera.T_cn_cnm1 * place_of(rig, index - 1, where, diagnostics);
  diagnostics.add({.code = "W-CONFIG",
                   .message = camera.name + " has no T_cam_imu",
                   .where = where,
                   .effect = "it is put into the origin of the body, with the axes of the body",
                   .next = "add T_cam_imu, or a file that has it"});
  return {};
}

}  // namespace

LensWords lens_words(LensModel model) { return std::ranges::find(kLenses, model, &LensRow::lens)->words; }

Camera camera_of(const CameraCalibration& calibration) {
  const auto row = std::ranges::find_if(kLenses, [&](const LensRow& lens) {
    return lens.words.model == calibration.model && lens.words.distortion_model == calibration.distortion_model;
  });
  if (row == std::end(kLenses)) {
    throw Error(ExitCode::kUsage, {.code = "E-CONFIG",
                                   .message = calibration.name + " is " + calibration.model + " with " +
                                              calibration.distortion_model + ", which no lens of this program is",
                                   .where = "",
                                   .effect = "nothing read",
                                   .next = "use pinhole with radtan, equidistant, fov or none, omni with radtan or "
                                           "none, ds or eucm with none"});
  }
  Camera camera{.name = calibration.name, .resolution_px = calibration.resolution_px};
  camera.lens.model = row->lens;
  const auto intrinsics = static_cast<Eigen::Index>(calibration.intrinsics.size());
  camera.lens.params.resize(intrinsics + static_cast<Eigen::Index>(calibration.distortion.size()));
  std::ranges::copy(calibration.intrinsics, camera.lens.params.data());
  std::ranges::copy(calibration.distortion, camera.lens.params.data() + intrinsics);
  camera.time_offset_s = calibration.timeshift_cam_imu.value_or(0.0);
  camera.shutter.line_delay_s = calibration.line_delay.value_or(0.0);
  const double readout_s = camera.shutter.line_delay_s * camera.resolution_px[1];
  if (readout_s * camera.rate_hz >= 1.0) camera.rate_hz = 0.5 / readout_s;
  return camera;
}

ImuNoise imu_noise_of(const ImuNoiseEntry& entry) {
  return {.gyro = noise_of(entry.gyro_white, entry.gyro_walk), .accel = noise_of(entry.accel_white, entry.accel_walk)};
}

Rig rig_of(const RigCalibration& calibration, const std::string& where, Diagnostics& diagnostics) {
  Rig rig;
  for (const ImuCalibration& imu : calibration.imus) rig.imus.push_back(imu_of(imu));
  for (std::size_t i = 0; i < calibration.cameras.size(); ++i) {
    rig.cameras.push_back(camera_of(calibration.cameras[i]));
    rig.cameras.back().T_c_b = place_of(calibration, i, where, diagnostics);
  }
  return rig;
}

RigCalibration calibration_of(const Rig& rig, std::vector<std::string>& notes) {
  RigCalibration calibration;
  for (const Imu& imu : rig.imus) calibration.imus.push_back(calibration_of(imu, notes));
  const Pose T_b_i = rig.imus.empty() ? Pose{} : rig.imus[0].accelerometer.T_b_i;
  for (const Camera& camera : rig.cameras) {
    calibration.cameras.push_back(calibration_of(camera));
    calibration.cameras.back().T_cam_imu = camera.T_c_b * T_b_i;
    if (camera.shutter.direction != ReadoutDirection::kDown && camera.shutter.line_delay_s != 0.0) {
      notes.push_back(camera.name + ": the direction of its reading is lost");
    }
  }
  return calibration;
}

}  // namespace vispline
