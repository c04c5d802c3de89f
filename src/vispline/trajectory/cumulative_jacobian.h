/// Derivatives of a cumulative B-spline with respect to its knots, X_m exp(delta_m). docs/math/spline.md (13)-(21).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "vispline/trajectory/cumulative.h"

namespace vispline {

/// What an increment d_j = log(X_{j-1}^-1 X_j) contributes to every evaluation near it: computed once per iterate.
///   delta d = J_r^-1(d) delta_j - J_l^-1(d) delta_{j-1},   J_l^-1 = J_r^-1 - ad(d)
template <class G>
struct KnotPair {
  typename G::template Tangent<double> d;
  typename G::template Operator<double> Jr_inv;

  KnotPair(const typename G::template Element<double>& previous, const typename G::template Element<double>& next)
      : d(G::template log<double>(G::template compose<double>(G::template inverse<double>(previous), next))),
        Jr_inv(G::template left_jacobian_inverse<double>(-d)) {}
};

/// d(X, V, dV)/d delta_m for the K knots of a segment, X perturbed on the right. Each is an Operator of the group:
/// dense() gives the matrix. V is filled from kDerivatives = 1 on, dV from 2 on.
template <class G, int K>
struct CumulativeJacobian {
  using Operator = typename G::template Operator<double>;
  std::array<Operator, K> X, V, dV;
};

namespace detail {

/// A derivative with respect to an increment becomes derivatives with respect to its two knots.
template <class G>
void to_knots(const typename G::template Operator<double>& D, const KnotPair<G>& pair,
              typename G::template Operator<double>& before, typename G::template Operator<double>& after) {
  after = D * pair.Jr_inv;
  before += G::times_ad(D, pair.d) - after;
}

}  // namespace detail

/// Forward: all blocks.
template <class G, int K, int kDerivatives = 2, int kOfPoint = 2>
CumulativeJacobian<G, K> cumulative_jacobian(const CumulativePoint<G, K, double, kOfPoint>& point,
                                             const KnotPair<G>* pairs) {
  using Operator = typename G::template Operator<double>;
  CumulativeJacobian<G, K> J;
  const auto& basis = point.basis;
  const Operator I = G::template identity_operator<double>();
  const auto ad_times = [](const auto& x, const Operator& M) { return G::template ad_times<double>(x, M); };
  J.X[0] = G::template Ad_inverse<double>(point.rest);
  if constexpr (kDerivatives >= 1) J.V[0] = J.dV[0] = 0.0 * I;
  for (std::size_t j = 0; j + 1 < K; ++j) {
    const bool last = j + 2 == K;
    const Operator M = basis.value[j] * G::template left_jacobian<double>(-basis.value[j] * pairs[j].d);
    const Operator S = last ? I : G::template Ad_inverse<double>(point.tail[j]);
    const Operator P = last ? M : Operator(S * M);
    detail::to_knots<G>(P, pairs[j], J.X[j], J.X[j + 1]);
    if constexpr (kDerivatives >= 1) {
      Operator DV = basis.d1[j] * S;
      if (j > 0) DV += ad_times(point.V_sum[j], P);
      detail::to_knots<G>(DV, pairs[j], J.V[j], J.V[j + 1]);
      if constexpr (kDerivatives >= 2) {
        Operator DdV =
            basis.d1[j] * ad_times(point.V_sum[j + 1], S) + basis.d2[j] * S - ad_times(point.V() - point.V_sum[j], DV);
        if (j > 0) DdV += ad_times(point.dV_sum[j], P);
        detail::to_knots<G>(DdV, pairs[j], J.dV[j], J.dV[j + 1]);
      }
    }
  }
  return J;
}

/// Reverse: L_X dX + L_V dV + L_dV d(dV) as one block of rows per knot, without forming the blocks above.
template <class G, int K, int kRows>
std::array<Eigen::Matrix<double, kRows, G::kDof>, K> cumulative_pull_back(
    const CumulativePoint<G, K>& point, const KnotPair<G>* pairs, const Eigen::Matrix<double, kRows, G::kDof>& L_X,
    const Eigen::Matrix<double, kRows, G::kDof>& L_V, const Eigen::Matrix<double, kRows, G::kDof>& L_dV) {
  using RowBlock = Eigen::Matrix<double, kRows, G::kDof>;
  std::array<RowBlock, K> blocks;
  const auto& basis = point.basis;
  blocks[0] = L_X * G::template Ad_inverse<double>(point.rest);
  for (std::size_t j = 0; j + 1 < K; ++j) {
    const RowBlock L_DV = L_V - G::times_ad(L_dV, typename G::template Tangent<double>(point.V() - point.V_sum[j]));
    RowBlock L_P = L_X;
    if (j > 0) L_P += G::times_ad(L_DV, point.V_sum[j]) + G::times_ad(L_dV, point.dV_sum[j]);
    RowBlock L_S = basis.d1[j] * (L_DV + G::times_ad(L_dV, point.V_sum[j + 1])) + basis.d2[j] * L_dV;
    if (j + 2 < K) {
      const auto S = G::template Ad_inverse<double>(point.tail[j]);
      L_P = (L_P * S).eval();
      L_S = (L_S * S).eval();
    }
    const auto M = G::template left_jacobian<double>(-basis.value[j] * pairs[j].d);
    const RowBlock L_d = basis.value[j] * (L_P * M) + L_S;
    blocks[j + 1] = L_d * pairs[j].Jr_inv;
    blocks[j] += G::times_ad(L_d, pairs[j].d) - blocks[j + 1];
  }
  return blocks;
}

/// Reverse: L_X dX alone.
template <class G, int K, int kRows, int kOfPoint>
std::array<Eigen::Matrix<double, kRows, G::kDof>, K> cumulative_pull_back(
    const CumulativePoint<G, K, double, kOfPoint>& point, const KnotPair<G>* pairs,
    const Eigen::Matrix<double, kRows, G::kDof>& L_X) {
  using RowBlock = Eigen::Matrix<double, kRows, G::kDof>;
  std::array<RowBlock, K> blocks;
  const auto& value = point.basis.value;
  blocks[0] = L_X * G::template Ad_inverse<double>(point.rest);
  for (std::size_t j = 0; j + 1 < K; ++j) {
    const RowBlock L_P = j + 2 < K ? RowBlock(L_X * G::template Ad_inverse<double>(point.tail[j])) : L_X;
    const RowBlock L_d = value[j] * (L_P * G::template left_jacobian<double>(-value[j] * pairs[j].d));
    blocks[j + 1] = L_d * pairs[j].Jr_inv;
    blocks[j] += G::times_ad(L_d, pairs[j].d) - blocks[j + 1];
  }
  return blocks;
}

}  // namespace vispline
