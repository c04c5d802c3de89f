/// How poses from a camera or from motion capture hang together with an IMU: the first stage of every calibration.
/// docs/math/estimate.md, Start values.
#pragma once

#include "vispline/core/error.h"
#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/estimate/pose_curve.h"
#include "vispline/sensors/recording.h"

namespace vispline {

struct PoseAlignment {
  double time_offset_s = 0.0;             ///< t_imu = t_pose + time_offset
  double correlation = 0.0;               ///< of |angular rate| at that offset
  double confidence = 0.0;                ///< 1 - second highest peak / highest
  Matrix3d R_b_s = Matrix3d::Identity();  ///< frame s of the poses to the frame of the IMU
  Vector3d gyro_bias = Vector3d::Zero();  ///< rad/s, in b
  double gyro_residual = 0.0;             ///< rad/s, standard deviation over axes
  Vector3d g_w = Vector3d::Zero();        ///< m/s^2: the mean of what the accelerometer feels, not scaled
  PoseCurve motion{};                     ///< T_w_s
};

/// Throws Error(kUnfit): E-OVERLAP, E-UNITS (angular rate in deg/s, force in g, no gravity), E-CLOCK (the rates do not
/// agree at any offset), E-EXCITATION (rotation about one axis only or none), E-AXES (rates agree in size but not in
/// direction, or the axes of the accelerometer are not those of the gyroscope).
PoseAlignment align_poses(const Signal<Pose>& T_w_s, const ImuSignal& imu, Diagnostics& diagnostics);

}  // namespace vispline
