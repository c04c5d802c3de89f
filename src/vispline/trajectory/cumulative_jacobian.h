/// Derivatives of a cumulative B-spline with respect to its knots, X_m exp(delta_m). docs/math/spline.md (13)-(21).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "vispline/trajectory/cumulative.h"

namespace vispline {

/// What an increment d_j = log(X_{j-1}^-1 X_j) contributes to every evaluation near it: computed once per iterate.
template <class G>
struct KnotPair {
  typename G::template Tangent<double> d;
  typename G::template Operator<double> Jr_inv;  ///< J_r^-1(d): delta d = J_r^-1 delta_j - J_l^-1 delta_{j-1}
  typename G::template Operator<double> Jl_inv;

  KnotPair(const typename G::template Element<double>& previous, const typename G::template Element<double>& next)
      : d(G::template log<double>(G::template compose<double>(G::template inverse<double>(previous), next))),
        Jr_inv(G::template left_jacobian_inverse<double>(-d)),
        Jl_inv(G::template left_jacobian_inverse<double>(d)) {}
};

/// d(X, V, dV)/d delta_m for the K knots of a segment, X perturbed on the right. Each is an Operator of the group:
/// dense() gives the matrix.
template <class G, int K>
struct CumulativeJacobian {
  using Operator = typename G::template Operator<double>;
  std::array<Operator, K> X, V, dV;
};

/// Forward: all blocks.
template <class G, int K>
CumulativeJacobian<G, K> cumulative_jacobian(const CumulativePoint<G, K>& point, const KnotPair<G>* pairs) {
  using Operator = typename G::template Operator<double>;
  CumulativeJacobian<G, K> J;
  const auto& basis = point.basis;
  const Operator I = G::template identity_operator<double>();
  J.X[0] = G::template Ad<double>(G::template inverse<double>(
      G::template compose<double>(G::template exp<double>(basis.value[0] * pairs[0].d), point.tail[0])));
  J.V[0] = J.dV[0] = 0.0 * I;
  for (std::size_t j = 0; j + 1 < K; ++j) {
    const bool last = j + 2 == K;
    const Operator M = basis.value[j] * G::template left_jacobian<double>(-basis.value[j] * pairs[j].d);
    const Operator S = last ? I : G::template Ad<double>(G::template inverse<double>(point.tail[j]));
    const Operator P = last ? M : Operator(S * M);
    const auto ad = [](const auto& x) { return G::template ad<double>(x); };
    const Operator DV = ad(point.V_sum[j]) * P + basis.d1[j] * S;
    const Operator DdV = ad(point.dV_sum[j]) * P + basis.d1[j] * (ad(point.V_sum[j + 1]) * S) + basis.d2[j] * S -
                         ad(point.V() - point.V_sum[j]) * DV;
    J.X[j] += -(P * pairs[j].Jl_inv);
    J.V[j] += -(DV * pairs[j].Jl_inv);
    J.dV[j] += -(DdV * pairs[j].Jl_inv);
    J.X[j + 1] = P * pairs[j].Jr_inv;
    J.V[j + 1] = DV * pairs[j].Jr_inv;
    J.dV[j + 1] = DdV * pairs[j].Jr_inv;
  }
  return J;
}

/// Reverse: L_X dX + L_V dV + L_dV d(dV) as one block of rows per knot, without forming the blocks above.
template <class G, int K, int kRows>
std::array<Eigen::Matrix<double, kRows, G::kDof>, K> cumulative_pull_back(
    const CumulativePoint<G, K>& point, const KnotPair<G>* pairs, const Eigen::Matrix<double, kRows, G::kDof>& L_X,
    const Eigen::Matrix<double, kRows, G::kDof>& L_V, const Eigen::Matrix<double, kRows, G::kDof>& L_dV) {
  using Rows = Eigen::Matrix<double, kRows, G::kDof>;
  std::array<Rows, K> blocks;
  const auto& basis = point.basis;
  const auto ad = [](const auto& x) { return G::template ad<double>(x); };
  blocks[0] = L_X * G::template Ad<double>(G::template inverse<double>(G::template compose<double>(
                        G::template exp<double>(basis.value[0] * pairs[0].d), point.tail[0])));
  for (std::size_t j = 0; j + 1 < K; ++j) {
    const Rows L_DV = L_V - L_dV * ad(point.V() - point.V_sum[j]);
    Rows L_P = L_X + L_DV * ad(point.V_sum[j]) + L_dV * ad(point.dV_sum[j]);
    Rows L_S = basis.d1[j] * L_DV + basis.d1[j] * (L_dV * ad(point.V_sum[j + 1])) + basis.d2[j] * L_dV;
    if (j + 2 < K) {
      const auto S = G::template Ad<double>(G::template inverse<double>(point.tail[j]));
      L_P = (L_P * S).eval();
      L_S = (L_S * S).eval();
    }
    const auto M = G::template left_jacobian<double>(-basis.value[j] * pairs[j].d);
    const Rows L_d = basis.value[j] * (L_P * M) + L_S;
    blocks[j] -= L_d * pairs[j].Jl_inv;
    blocks[j + 1] = L_d * pairs[j].Jr_inv;
  }
  return blocks;
}

}  // namespace vispline
