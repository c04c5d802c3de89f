/// Accelerometer: specific force along three sensitive axes. docs/math/imu.md.
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "vispline/sensors/sensor.h"
#include "vispline/sensors/specific_force.h"
#include "vispline/sensors/triad.h"

namespace vispline {

struct Accelerometer {
  static constexpr std::string_view kName = "accelerometer";
  using Sample = Vector3d;  ///< m/s^2 in frame i

  /// Exact and in the origin of the body by default.
  template <class T>
  struct Params {
    PoseT<T> T_b_i;                                ///< pose of the instrument in the body
    Vector3<T> scale = Vector3<T>::Zero();         ///< relative error of each axis
    Vector6<T> misalignment = Vector6<T>::Zero();  ///< (xy, xz, yx, yz, zx, zy), sensors/triad.h
    Vector3<T> bias = Vector3<T>::Zero();          ///< m/s^2
    T time_offset_s = T(0);                        ///< t_body = t_sensor + time_offset

    auto tie() { return std::tie(T_b_i, scale, misalignment, bias, time_offset_s); }
    auto tie() const { return std::tie(T_b_i, scale, misalignment, bias, time_offset_s); }
  };

  static constexpr std::array<Block, 5> kBlocks{{{"T_b_i", 12, Space::kSE3, "m, rad"},
                                                 {"scale", 3, Space::kEuclidean, "1"},
                                                 {"misalignment", 6, Space::kEuclidean, "1"},
                                                 {"bias", 3, Space::kEuclidean, "m/s^2"},
                                                 {"time_offset", 1, Space::kEuclidean, "s"}}};
  static constexpr int kParams = tangent_offset(kBlocks, kBlocks.size());

  /// Reading without noise, for the body's state at stamp + time_offset.
  ///   f_i = M R_i_b (R_b_w (a_w - g_w) + alpha_b x p_b_i + omega_b x (omega_b x p_b_i)) + bias  docs/math/imu.md (7)
  /// m/s^2 in frame i. g_w points down: at rest with z up the reading is (0, 0, +9.81). Never fails.
  template <class T>
  static Vector3<T> predict(const BodyStateT<T>& state, const Params<T>& params, const Vector3<T>& g_w) {
    return triad_matrix(params.scale, params.misalignment) * specific_force(state, params.T_b_i, g_w) + params.bias;
  }

  /// predict() and its derivatives; docs/math/imu.md (14). `state_rate` is d(state tangent)/dt, for time_offset only.
  static Linearization<3, kParams> linearize(const BodyState& state, const BodyTangent& state_rate,
                                             const Params<double>& params, const Vector3d& g_w);
};

static_assert(LinearizedSensor<Accelerometer>);

}  // namespace vispline
