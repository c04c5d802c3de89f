/// What the tests of the Lie groups share: dense operators, distances and the points where formulas break first.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "vispline/core/rn.h"
#include "vispline/core/se3.h"
#include "vispline/core/split_pose.h"

namespace vispline::testing {

template <class G, class T = double>
using Tangent = typename G::template Tangent<T>;
template <class G, class T = double>
using Element = typename G::template Element<T>;
template <class G>
using Operator = typename G::template Operator<double>;
template <class G>
using Dense = Eigen::Matrix<double, G::kDof, G::kDof>;

/// The operator of G as a plain matrix.
template <class G>
Dense<G> dense(const Operator<G>& M) {
  if constexpr (requires { M.dense(); }) {
    return M.dense();
  } else {
    return M * Dense<G>::Identity();
  }
}

inline double distance(const Pose& a, const Pose& b) {
  return std::max((a.R - b.R).cwiseAbs().maxCoeff(), (a.p - b.p).cwiseAbs().maxCoeff());
}
template <class A, class B>
double distance(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// Angles (rad) at which exp, log or a Jacobian could fail: 0, tiny, both sides of the series border at 1, and pi.
inline std::vector<double> nasty_angles() {
  constexpr double pi = std::numbers::pi;
  return {0.0, 1e-12, 1e-8, 1e-4, 0.5, 1.0 - 1e-9, 1.0 + 1e-9, 2.0, 3.0, pi - 1e-8, pi};
}

/// A random tangent whose rotation (or, without one, whole vector) has the given length; the translation is generic.
template <class G>
Tangent<G> random_tangent(double angle, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Tangent<G> x;
  for (double& entry : x) entry = normal(random);
  x.template tail<3>() *= angle / x.template tail<3>().norm();
  return x;
}

/// Several directions at each of the angles.
template <class G>
std::vector<Tangent<G>> tangents(const std::vector<double>& angles) {
  std::mt19937_64 random(7);
  std::vector<Tangent<G>> points;
  for (const double angle : angles) {
    for (int i = 0; i < 5; ++i) points.push_back(random_tangent<G>(angle, random));
  }
  return points;
}

template <class G>
std::vector<Tangent<G>> nasty_tangents() {
  return tangents<G>(nasty_angles());
}

/// sum_n M^n / (n + offset)!: exp for offset 0, the left Jacobian of M = ad for offset 1.
template <class Matrix>
Matrix power_series(const Matrix& M, int offset) {
  Matrix power = Matrix::Identity(), sum = Matrix::Identity();
  double factorial = 1.0;
  for (int n = 1; n < 60; ++n) {
    power = power * M;
    factorial *= n + offset;
    sum += power / factorial;
  }
  return sum;
}

}  // namespace vispline::testing
