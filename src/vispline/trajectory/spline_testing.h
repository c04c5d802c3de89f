/// Random splines for tests: generic points, and the same knots for dual numbers.
#pragma once

#include <ceres/jet.h>

#include <array>
#include <vector>

#include "vispline/core/random.h"
#include "vispline/core/rn.h"
#include "vispline/core/se3.h"
#include "vispline/core/split_pose.h"
#include "vispline/trajectory/spline.h"

namespace vispline::testing {

/// A tangent with independent normal entries.
template <class Tangent>
Tangent random_tangent(const RandomStream& stream, std::uint64_t index, double sigma) {
  Tangent x;
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = sigma * stream.normal(64 * index + static_cast<std::uint64_t>(i));
  return x;
}

/// A random walk of knots; step is the standard deviation of each axis of an increment.
template <class G>
std::vector<typename G::template Element<double>> random_knots(std::uint64_t seed, std::size_t count, double step) {
  using Tangent = typename G::template Tangent<double>;
  const RandomStream stream(seed, "knots");
  std::vector<typename G::template Element<double>> knots{
      G::template exp<double>(random_tangent<Tangent>(stream, 0, 1.0))};
  while (knots.size() < count) {
    knots.push_back(G::template compose<double>(
        knots.back(), G::template exp<double>(random_tangent<Tangent>(stream, knots.size(), step))));
  }
  return knots;
}

/// Knot X_m exp(delta_m) as dual numbers whose derivatives are those with respect to delta_m.
template <class G, int K>
auto dual_knots(const std::array<typename G::template Element<double>, K>& knots) {
  using Jet = ceres::Jet<double, K * G::kDof>;
  std::array<typename G::template Element<Jet>, K> dual;
  for (int m = 0; m < K; ++m) {
    typename G::template Tangent<Jet> delta;
    for (int i = 0; i < G::kDof; ++i) delta(i) = Jet(0.0, m * G::kDof + i);
    dual[static_cast<std::size_t>(m)] =
        G::template compose<Jet>(knots[static_cast<std::size_t>(m)].template cast<Jet>(), G::template exp<Jet>(delta));
  }
  return dual;
}

/// Derivatives of a vector of dual numbers, one row each.
template <int kColumns, class Vector>
Eigen::MatrixXd derivatives(const Vector& x) {
  Eigen::MatrixXd J(x.size(), kColumns);
  for (Eigen::Index i = 0; i < x.size(); ++i) J.row(i) = x(i).v.transpose();
  return J;
}

}  // namespace vispline::testing
