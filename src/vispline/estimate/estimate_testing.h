/// A small made-up estimation at generic values: everything different, nothing the identity.
#pragma once

#include <random>
#include <vector>

#include "vispline/core/se3.h"
#include "vispline/estimate/problem.h"

namespace vispline::testing {

class Generic {
 public:
  explicit Generic(std::uint64_t seed) : random_(seed) {}
  double number(double sigma) { return sigma * normal_(random_); }
  Vector3d vector(double sigma) { return {number(sigma), number(sigma), number(sigma)}; }
  Eigen::VectorXd vector(Eigen::Index size, double sigma) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return number(sigma); });
  }
  Pose pose(double position, double rotation) { return {SO3::exp<double>(vector(rotation)), vector(position)}; }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

/// A wobbling curve over [0, 1.2] s, two IMUs, a rolling-shutter and a global camera, one outside reference.
inline State generic_state(const CurveShape& shape, std::uint64_t seed) {
  Generic generic(seed);
  State state;
  const Pose first = generic.pose(0.3, 0.4);
  state.curve =
      make_curve(shape, {Time{}, Time{} + from_seconds(1.2)}, [&](Time) { return first * generic.pose(0.1, 0.15); });
  for (const char* name : {"imu0", "imu1"}) {
    Imu imu;
    imu.name = name;
    imu.gyroscope.T_b_i = imu.accelerometer.T_b_i = generic.pose(0.1, 0.5);
    imu.gyroscope.scale = generic.vector(0.01);
    imu.gyroscope.misalignment = generic.vector(6, 0.01);
    imu.gyroscope.g_sensitivity.col(1) = generic.vector(0.001);
    imu.gyroscope.bias = generic.vector(0.1);
    imu.accelerometer.scale = generic.vector(0.01);
    imu.accelerometer.misalignment = generic.vector(6, 0.01);
    imu.accelerometer.bias = generic.vector(0.1);
    imu.gyroscope.time_offset_s = imu.accelerometer.time_offset_s = generic.number(0.003);
    state.rig.imus.push_back(imu);
  }
  Camera camera;
  camera.lens = {LensModel::kPinholeRadtan,
                 (LensParams(8) << 420.0, 431.0, 318.0, 241.0, -0.11, 0.02, 0.001, -0.0007).finished()};
  camera.T_c_b = generic.pose(0.1, 0.1);
  camera.time_offset_s = 0.0021;
  camera.shutter.line_delay_s = 4.1e-5;
  state.rig.cameras.push_back(camera);
  camera.name = "cam1";
  camera.lens = {LensModel::kDoubleSphere, (LensParams(6) << -0.17, 0.59, 158.3, 158.1, 254.9, 256.9).finished()};
  camera.resolution_px = {512, 512};
  camera.T_c_b = generic.pose(0.1, 0.1);
  camera.shutter.line_delay_s = 0.0;
  state.rig.cameras.push_back(camera);
  state.references.push_back({generic.pose(1.0, 1.0), generic.pose(0.2, 1.0), 0.004});
  state.g_w = Vector3d(0.3, -0.2, -9.79);
  return state;
}

/// Everything free.
inline std::vector<Parameter> all_free(const State& state) {
  std::vector<Parameter> parameters = parameters_of(state);
  for (Parameter& parameter : parameters) parameter.treatment.role = Role::kFree;
  return parameters;
}

/// Step of a central difference: as far as a pixel moves by little.
inline double step_of(const std::vector<Parameter>& parameters, int column) {
  for (const Parameter& parameter : parameters) {
    if (column < parameter.column || column >= parameter.column + parameter.size) continue;
    if (parameter.name.ends_with("line_delay")) return 1e-9;
    if (parameter.name.ends_with("time_offset")) return 1e-7;
  }
  return 1e-6;
}

}  // namespace vispline::testing
