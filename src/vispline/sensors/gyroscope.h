/// Gyroscope: angular rate of the body along three sensitive axes. docs/math/imu.md.
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "vispline/sensors/sensor.h"
#include "vispline/sensors/specific_force.h"
#include "vispline/sensors/triad.h"

namespace vispline {

struct Gyroscope {
  static constexpr std::string_view kName = "gyroscope";
  using Sample = Vector3d;  ///< rad/s in frame i

  /// Exact and in the origin of the body by default.
  template <class T>
  struct Params {
    PoseT<T> T_b_i;                                 ///< pose of the instrument in the body
    Vector3<T> scale = Vector3<T>::Zero();          ///< relative error of each axis
    Vector6<T> misalignment = Vector6<T>::Zero();   ///< (xy, xz, yx, yz, zx, zy), sensors/triad.h
    Matrix3<T> g_sensitivity = Matrix3<T>::Zero();  ///< A_g, rad/s per m/s^2 in frame i
    Vector3<T> bias = Vector3<T>::Zero();           ///< rad/s
    T time_offset_s = T(0);                         ///< t_body = t_sensor + time_offset

    auto tie() { return std::tie(T_b_i, scale, misalignment, g_sensitivity, bias, time_offset_s); }
    auto tie() const { return std::tie(T_b_i, scale, misalignment, g_sensitivity, bias, time_offset_s); }
  };

  static constexpr std::array<Block, 6> kBlocks{{{"T_b_i", 12, Space::kSE3, "m, rad"},
                                                 {"scale", 3, Space::kEuclidean, "1"},
                                                 {"misalignment", 6, Space::kEuclidean, "1"},
                                                 {"g_sensitivity", 9, Space::kEuclidean, "(rad/s)/(m/s^2)"},
                                                 {"bias", 3, Space::kEuclidean, "rad/s"},
                                                 {"time_offset", 1, Space::kEuclidean, "s"}}};
  static constexpr int kParams = tangent_offset(kBlocks, kBlocks.size());

  /// Reading without noise, for the body's state at stamp + time_offset.
  ///   omega_i = M_g R_i_b omega_b + A_g f_i + bias                                      docs/math/imu.md (6)
  /// rad/s in frame i; f_i is the specific force (4) at the gyroscope. Never fails.
  template <class T>
  static Vector3<T> predict(const BodyStateT<T>& state, const Params<T>& params, const Vector3<T>& g_w) {
    const Matrix3<T> M_g = triad_matrix(params.scale, params.misalignment);
    return M_g * (params.T_b_i.R.transpose() * state.omega_b) +
           params.g_sensitivity * specific_force(state, params.T_b_i, g_w) + params.bias;
  }

  /// predict() and its derivatives; docs/math/imu.md (13). `state_rate` is d(state tangent)/dt, for time_offset only.
  static Linearization<3, kParams> linearize(const BodyState& state, const BodyTangent& state_rate,
                                             const Params<double>& params, const Vector3d& g_w);
};

static_assert(LinearizedSensor<Gyroscope>);

}  // namespace vispline
