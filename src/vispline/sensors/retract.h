/// Perturbing states and parameters: x (+) delta in the space of each block. docs/conventions.md, Perturbations.
/// With a dual delta the result is dual, which is how a model is differentiated with respect to its blocks.
#pragma once

#include <cstddef>
#include <tuple>
#include <utility>

#include "vispline/core/block.h"
#include "vispline/core/body_state.h"
#include "vispline/core/se3.h"

namespace vispline {

/// T exp(delta), delta = (translation, rotation) in the frame right of T.
template <class T>
PoseT<T> retract(const Pose& pose, const Vector6<T>& delta) {
  return pose.cast<T>() * SE3::exp<T>(delta);
}

/// x + delta; a matrix is perturbed column by column.
template <class T, int kRows, int kCols>
Eigen::Matrix<T, kRows, kCols> retract(const Eigen::Matrix<double, kRows, kCols>& x,
                                       const Eigen::Matrix<T, kRows * kCols, 1>& delta) {
  return x.template cast<T>() + delta.template reshaped<Eigen::ColMajor>(kRows, kCols);
}

template <class T>
T retract(double x, const Eigen::Matrix<T, 1, 1>& delta) {
  return T(x) + delta[0];
}

/// State moved by a tangent with the layout of core/body_state.h.
template <class T>
BodyStateT<T> retract(const BodyState& state, const Eigen::Matrix<T, body_tangent::kSize, 1>& delta) {
  using namespace body_tangent;
  const PoseT<T> T_w_b = retract<T>(state.T_w_b(), Vector6<T>(delta.template segment<6>(kPosition)));
  BodyStateT<T> moved = state.cast<T>();
  moved.R_w_b = T_w_b.R;
  moved.p_w = T_w_b.p;
  moved.v_w += delta.template segment<3>(kVelocity);
  moved.omega_b += delta.template segment<3>(kOmega);
  moved.a_w += delta.template segment<3>(kAcceleration);
  moved.alpha_b += delta.template segment<3>(kAlpha);
  return moved;
}

/// All parameters of a sensor moved at once; delta has the columns of the sensor's kBlocks.
template <class Sensor, class T>
typename Sensor::template Params<T> retract_params(const typename Sensor::template Params<double>& params,
                                                   const Eigen::Matrix<T, Sensor::kParams, 1>& delta) {
  typename Sensor::template Params<T> moved;
  const auto from = params.tie();
  auto to = moved.tie();
  const auto move_block = [&]<std::size_t i>() {
    constexpr int kSize = Sensor::kBlocks[i].tangent_size();
    const Eigen::Matrix<T, kSize, 1> block = delta.template segment<kSize>(tangent_offset(Sensor::kBlocks, i));
    std::get<i>(to) = retract<T>(std::get<i>(from), block);
  };
  [&]<std::size_t... i>(std::index_sequence<i...>) { (move_block.template operator()<i>(), ...); }
  (std::make_index_sequence<Sensor::kBlocks.size()>());
  return moved;
}

}  // namespace vispline
