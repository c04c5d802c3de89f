/// A parameter of the rig or of the world: its name, its unit, what is to be done with it, and how it moves.
/// docs/math/estimate.md, Parameters.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "vispline/estimate/plane_across.h"
#include "vispline/estimate/state.h"

namespace vispline {

enum class Role { kFree, kFixed, kPrior };

/// What to do with a parameter; sigma (of a prior around the start value) in the parameter's unit.
struct Treatment {
  Role role = Role::kFree;
  double sigma = 0.0;
};

struct Parameter {
  std::string name;  ///< "cam0.T_c_b.rotation"
  std::string unit;
  int size = 0;  ///< of a perturbation
  Treatment treatment{};
  std::function<Eigen::VectorXd(const State&)> value;                        ///< as it is reported
  std::function<void(State&, const Eigen::VectorXd& delta)> move;            ///< in the sense of docs/conventions.md
  std::function<Eigen::VectorXd(const State& from, const State& to)> delta;  ///< that moves `from` to `to`
  int column = -1;                                                           ///< -1: fixed
};

/// All parameters that a state has, in one order: gravity, then IMUs, cameras, references. Rotations are perturbed on
/// the right, translations and all else by addition. Everything is fixed until told otherwise.
std::vector<Parameter> parameters_of(const State& state);

/// The parameter called `name`; throws Error E-CONFIG with the nearest names if there is none. "cam*.T_c_b" style
/// patterns: `*` matches any run of letters and digits, a missing tail matches all that begin so.
std::vector<Parameter*> find_parameters(std::vector<Parameter>& parameters, const std::string& pattern);

/// Columns of the parameters of one camera, IMU or reference; -1: fixed.
struct CameraColumns {
  int translation = -1, rotation = -1, intrinsics = -1, time_offset = -1, line_delay = -1;
};
/// Of the misalignments (xy, xz, yx, yz, zx, zy), sensors/triad.h, those below and those above the diagonal: with all
/// six of a triad and its rotation free, the rotation would be there twice.
inline constexpr std::array<int, 3> kLower{2, 4, 5}, kUpper{0, 1, 3};

struct ImuColumns {
  int translation = -1, rotation = -1, time_offset = -1;
  int gyro_bias = -1, gyro_scale = -1, gyro_lower = -1, gyro_upper = -1, gyro_g_sensitivity = -1;
  int accel_time_offset = -1, accel_bias = -1, accel_scale = -1, accel_lower = -1, accel_upper = -1;
};
struct ReferenceColumns {
  int world_translation = -1, world_rotation = -1, translation = -1, rotation = -1, time_offset = -1;
};
struct GravityColumns {
  int direction = -1, magnitude = -1;
};
struct ParameterColumns {
  std::map<std::string, int> by_name{};
  GravityColumns gravity{};
  std::vector<ImuColumns> imus{};
  std::vector<CameraColumns> cameras{};
  std::vector<ReferenceColumns> references{};
};
ParameterColumns columns_of(const State& state, const std::vector<Parameter>& parameters);

}  // namespace vispline
