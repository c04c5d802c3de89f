/// The one recursion: a cumulative B-spline of order K on a Lie group G and its time derivatives, linear in K.
/// docs/math/spline.md, equations (4)-(12). Lovegrove et al. 2013, equations (4)-(6) with the indices put right;
/// Sommer et al. 2020 for SO(3), carried over to any group here.
#pragma once

#include <array>
#include <cstddef>

#include "vispline/trajectory/basis.h"

namespace vispline {

/// Element X and its body velocity V = vee(X^-1 dX/dt) with two time derivatives, per second.
template <class G, class T = double>
struct Kinematics {
  typename G::template Element<T> X;
  typename G::template Tangent<T> V, dV, ddV;
};

/// Everything about one instant that the values and the Jacobians share. With A_j = exp(lambda_j d_j) and the tail
/// B_j = A_{j+1} ... A_{K-1}, each increment is carried to the final body frame once, s_j = Ad(B_j^-1) d_j; there the
/// recursions for velocity and acceleration are plain prefix sums.
template <class G, int K, class T = double, int kDerivatives = 2>
struct CumulativePoint {
  static constexpr std::size_t kIncrements = K - 1;
  using Element = typename G::template Element<T>;
  using Tangent = typename G::template Tangent<T>;

  Element X;                              ///< the curve
  Element rest;                           ///< A_1 ... A_{K-1}: the curve is first * rest
  std::array<Element, kIncrements> tail;  ///< B_j, j = 1..K-1; the last is the identity
  std::array<Tangent, kIncrements> s;     ///< s_j
  std::array<Tangent, K> V_sum, dV_sum;   ///< prefix sums: [j] holds the first j increments; dV from 2 derivatives on
  const CumulativeBasis<K, T>& basis;

  /// d: the K-1 increments log(X_{j-1}^-1 X_j) after the knot `first`.
  CumulativePoint(const Element& first, const std::array<Tangent, kIncrements>& d, const CumulativeBasis<K, T>& b)
      : basis(b) {
    Element product = G::template identity<T>();
    for (std::size_t j = kIncrements; j-- > 0;) {
      tail[j] = product;
      s[j] = j + 1 == kIncrements ? d[j] : G::template Ad_inverse<T>(product, d[j]);
      const Element A = G::template exp<T>(b.value[j] * d[j]);
      product = j + 1 == kIncrements ? A : G::template compose<T>(A, product);
    }
    rest = product;
    X = G::template compose<T>(first, rest);
    V_sum[0].setZero();
    for (std::size_t j = 0; j < kIncrements; ++j) V_sum[j + 1] = V_sum[j] + b.d1[j] * s[j];
    if constexpr (kDerivatives < 2) return;
    dV_sum[0].setZero();
    for (std::size_t j = 0; j < kIncrements; ++j) {
      dV_sum[j + 1] = dV_sum[j] + b.d1[j] * G::template bracket<T>(V_sum[j + 1], s[j]) + b.d2[j] * s[j];
    }
  }

  const Tangent& V() const { return V_sum[kIncrements]; }
  const Tangent& dV() const { return dV_sum[kIncrements]; }

  Tangent ddV() const {
    Tangent sum = Tangent::Zero();
    for (std::size_t j = 0; j < kIncrements; ++j) {
      const Tangent Vs = G::template bracket<T>(V_sum[j + 1], s[j]);
      sum += (2.0 * basis.d1[j]) * G::template bracket<T>(dV_sum[j + 1], s[j]) +
             (basis.d1[j] * basis.d1[j]) * G::template bracket<T>(s[j], Vs) + basis.d2[j] * Vs + basis.d3[j] * s[j];
    }
    return sum;
  }
};

/// The curve alone.
template <class G, int K, class T>
typename G::template Element<T> cumulative_element(const typename G::template Element<T>& first,
                                                   const std::array<typename G::template Tangent<T>, K - 1>& d,
                                                   const CumulativeBasis<K, T>& basis) {
  typename G::template Element<T> X = first;
  for (std::size_t j = 0; j + 1 < K; ++j) X = G::template compose<T>(X, G::template exp<T>(basis.value[j] * d[j]));
  return X;
}

/// From the K knots themselves, for any scalar: the form that dual numbers differentiate.
template <class G, int K, class T>
Kinematics<G, T> cumulative_kinematics(const std::array<typename G::template Element<T>, K>& knots,
                                       const CumulativeBasis<K, T>& basis) {
  std::array<typename G::template Tangent<T>, K - 1> d;
  for (std::size_t j = 0; j + 1 < K; ++j) {
    d[j] = G::template log<T>(G::template compose<T>(G::template inverse<T>(knots[j]), knots[j + 1]));
  }
  const CumulativePoint<G, K, T> point(knots[0], d, basis);
  return {point.X, point.V(), point.dV(), point.ddV()};
}

}  // namespace vispline
