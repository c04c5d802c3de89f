/// A made-up calibration for tests of documents and pages: every field set, every kind of unit.
#pragma once

#include "vispline/results/calibration_result.h"

namespace vispline::testing {

inline CalibrationResult calibration_result() {
  CalibrationResult r;
  r.result_class = ResultClass::kConvergedWeak;
  r.reasons = {"cam0.T_c_i.translation y is not observable: sigma 0.041 m, limit 0.02 m"};
  r.parameters.push_back({"cam0.T_c_i.translation",
                          "m",
                          {{"x", "m", 0.0301, 0.0, 0.0004, 0.02, 0.03, 0.0001},
                           {"y", "m", 0.09, 0.0, 0.041, 0.02, 0.05, 0.04},
                           {"z", "m", -0.0102, 0.0, 0.0003, 0.02, -0.01, -0.0002}},
                          std::nullopt});
  r.parameters.push_back({"cam0.T_c_i.rotation",
                          "rad",
                          {{"x", "rad", 1.2, 1.1, 0.0002, 0.01, 1.2001, -0.0001},
                           {"y", "rad", -0.3, -0.2, 0.0002, 0.01, -0.3, 0.0},
                           {"z", "rad", 0.1, 0.0, 0.0001, 0.01, 0.1, 0.0}},
                          std::nullopt});
  r.parameters.push_back({"cam0.intrinsics",
                          "px, 1",
                          {{"fu", "px", 420.1, 410.0, 0.2, 4.2, 420.0, 0.1},
                           {"k1", "1", -0.11, 0.0, 0.001, 0.1, std::nullopt, std::nullopt}},
                          0.5});
  r.parameters.push_back({"cam0.line_delay", "s", {{"", "s", 2.9e-5, 1e-5, 1e-7, 2e-6, 3e-5, -1e-6}}, std::nullopt});
  r.fixed = {"gravity.magnitude"};
  r.correlation_labels = {"cam0.T_c_i.translation x", "cam0.line_delay"};
  r.correlation = (Eigen::Matrix2d() << 1.0, -0.3, -0.3, 1.0).finished();
  r.condition = 1.86;
  r.gradient_sigmas = 0.003;
  r.curvature_low = 0.99;
  r.curvature_high = 1.01;
  SensorResiduals camera;
  camera.sensor = "cam0";
  camera.unit = "px";
  camera.count = 4;
  camera.sigma = camera.rig_sigma = 0.5;
  camera.rms = 0.51;
  camera.dof = 3.5;
  camera.chi2_per_dof = 1.05;
  camera.lag1 = 0.01;
  camera.lag1_low = -0.2;
  camera.lag1_high = 0.1;
  camera.lost = 1;
  camera.time_s = {0.5, 0.5};
  camera.residual = {{0.4, -0.6}, {0.5, -0.5}};
  camera.px = {{100.0, 50.0}, {500.0, 400.0}};
  r.residuals.push_back(camera);
  SensorResiduals gyro = camera;
  gyro.sensor = "imu0.gyroscope";
  gyro.unit = "rad/s";
  gyro.px.clear();
  gyro.lost = 0;
  gyro.residual = {{0.001, -0.002}, {0.002, 0.0}, {-0.001, 0.001}};
  gyro.sigma = gyro.rig_sigma = gyro.rms = 0.0015;
  r.residuals.push_back(gyro);
  r.nees = 0.97;
  r.held.push_back({"cam0.line_delay", "s", 0.691, {53.5e-6}, {0.29e-6}});
  r.weak.push_back({true,
                    "cam0.T_c_i.translation along y: 41 mm",
                    "turn faster about x and z",
                    2.05,
                    {{"cam0.T_c_i.translation y", 0.041}}});
  r.stages.push_back({"clock of cam0", 0.97, 0.5, "1", true, "correlation of |angular rate| with the IMU"});
  r.knots = {0.05, 4, "se3", "given"};
  r.first_cost = 1e6;
  r.cost = 1234.5;
  r.iterations = 12;
  r.cpu_s = {{"read", 0.25}, {"solve", 1.5}};
  r.trajectory.emplace();
  r.trajectory->position_m.rmse = 0.002;
  r.trajectory->rotation_rmse_deg = 0.1;
  r.jackknife = Jackknife{10, {{"cam0.T_c_i.translation x", "m", 0.0004, 0.0005, 0.0}}};
  r.twin = Twin{100, 1, 9, 1.02, 0.9, 1.1, 0.951, {{"cam0.T_c_i.translation x", "m", 0.0004, 0.00041, 0.95}}};
  r.diagnostics.add({.code = "W-CURVATURE", .message = "m", .where = "", .effect = "e", .next = "n"});
  return r;
}

}  // namespace vispline::testing
