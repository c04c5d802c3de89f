/// Cameras and IMUs as calibration files describe them: plain values in the words of Kalibr. docs/calibration-files.md.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vispline/calibration/noise_entry.h"
#include "vispline/core/error.h"
#include "vispline/core/pose.h"

namespace vispline {

/// `model` and the order of `intrinsics`, px unless said: "pinhole" fu fv pu pv; "omni" xi fu fv pu pv; "ds" xi alpha
/// fu fv pu pv; "eucm" alpha beta fu fv pu pv (xi, alpha, beta without unit). `distortion_model`: "radtan" k1 k2 p1 p2,
/// "equidistant" k1 k2 k3 k4, "fov" w, "none".
struct CameraCalibration {
  std::string name = "cam0";
  std::string model = "pinhole";
  std::vector<double> intrinsics{};
  std::string distortion_model = "none";
  std::vector<double> distortion{};
  std::array<int, 2> resolution_px{};         ///< width, height
  std::optional<Pose> T_cam_imu{};            ///< coordinates in the IMU to coordinates in the camera, m
  std::optional<Pose> T_cn_cnm1{};            ///< camera before this one in the chain to this one, m
  std::optional<double> timeshift_cam_imu{};  ///< s: t_imu = t_cam + timeshift
  std::optional<double> line_delay{};         ///< s from row to row
  std::vector<int> overlaps{};                ///< cameras that see the same things
  std::string topic{};
};

/// A raw reading is M (ideal reading in the sensor's own frame) + bias + noise; docs/calibration-files.md.
struct ImuCalibration {
  ImuNoiseEntry noise{};
  Pose T_i_b{};                                 ///< coordinates in the body to coordinates in this IMU, m
  double time_offset = 0.0;                     ///< s, to the first IMU
  Matrix3d gyro_M = Matrix3d::Identity();       ///< scale and misalignment: Kalibr gyroscopes.M, OpenVINS Tw
  Matrix3d R_gyro_imu = Matrix3d::Identity();   ///< Kalibr C_gyro_i, OpenVINS R_IMUtoGYRO
  Matrix3d gyro_A = Matrix3d::Zero();           ///< effect of acceleration, rad/s per m/s^2: Kalibr A, OpenVINS Tg
  Matrix3d accel_M = Matrix3d::Identity();      ///< Kalibr accelerometers.M, OpenVINS Ta
  Matrix3d R_accel_imu = Matrix3d::Identity();  ///< OpenVINS R_IMUtoACC; Kalibr has none
};

struct RigCalibration {
  std::vector<CameraCalibration> cameras{};
  std::vector<ImuCalibration> imus{};
};

struct RigReading {
  std::string dialect{};  ///< one of rig_dialects()
  RigCalibration rig{};   ///< what the file holds: cameras, IMUs or both
  Diagnostics diagnostics{};
};

/// No scale, misalignment, rotation of a triad or effect of acceleration on the gyroscope.
bool is_ideal(const ImuCalibration& imu);

/// T_cam_imu of camera `index`, from the chain T_cn_cnm1 where it is not given; empty if neither reaches an IMU.
std::optional<Pose> imu_to_camera(const RigCalibration& rig, std::size_t index);

/// Focal lengths and principal point fu fv pu pv, whatever stands before them. Precondition: a valid camera.
std::array<double, 4> projection_of(const CameraCalibration& camera);

}  // namespace vispline
