// One list of laws, run on every group at nasty points. docs/math/lie.md.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "vispline/core/lie_testing.h"

namespace vispline::testing {
namespace {

constexpr double kTolerance = 2e-14;  // translations here are below 5 m

template <class Group>
class LieGroup : public ::testing::Test {};
using Groups = ::testing::Types<SO3, SE3, Rn<3>, Rn<6>, SplitPose>;
TYPED_TEST_SUITE(LieGroup, Groups);

template <class G>
Element<G> exp_of(const Tangent<G>& x) {
  return G::template exp<double>(x);
}

TYPED_TEST(LieGroup, IdentityIsNeutral) {
  using G = TypeParam;
  const Element<G> one = G::template identity<double>();
  EXPECT_EQ(distance(exp_of<G>(Tangent<G>::Zero()), one), 0.0);
  EXPECT_EQ(G::template log<double>(one).norm(), 0.0);
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const Element<G> X = exp_of<G>(x);
    EXPECT_EQ(distance(G::template compose<double>(one, X), X), 0.0);
    EXPECT_EQ(distance(G::template compose<double>(X, one), X), 0.0);
  }
}

TYPED_TEST(LieGroup, InverseUndoes) {
  using G = TypeParam;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const Element<G> X = exp_of<G>(x), inverse = G::template inverse<double>(X);
    EXPECT_LT(distance(G::template compose<double>(X, inverse), G::template identity<double>()), kTolerance);
    EXPECT_LT(distance(exp_of<G>(-x), inverse), kTolerance) << x.transpose();
  }
}

TYPED_TEST(LieGroup, CompositionIsAssociative) {
  using G = TypeParam;
  const auto points = nasty_tangents<G>();
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Element<G> X = exp_of<G>(points[i]), Y = exp_of<G>(points[i - 1]), Z = exp_of<G>(points[i / 2]);
    const auto left = G::template compose<double>(G::template compose<double>(X, Y), Z);
    const auto right = G::template compose<double>(X, G::template compose<double>(Y, Z));
    EXPECT_LT(distance(left, right), kTolerance);
  }
}

TYPED_TEST(LieGroup, LogInvertsExpBelowPi) {
  using G = TypeParam;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    if (x.template tail<3>().norm() > 3.1415926) continue;  // the sign at pi is tested by ExpInvertsLog
    EXPECT_LT(distance(G::template log<double>(exp_of<G>(x)), x), kTolerance) << x.transpose();
  }
}

TYPED_TEST(LieGroup, ExpInvertsLogUpToPi) {
  using G = TypeParam;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const Element<G> X = exp_of<G>(x);
    EXPECT_LT(distance(exp_of<G>(G::template log<double>(X)), X), kTolerance) << x.transpose();
  }
}

TYPED_TEST(LieGroup, LogKeepsTheDigitsOfTinyVectors) {
  using G = TypeParam;
  for (const double scale : {1e-5, 1e-9, 1e-15, 1e-100}) {
    for (const Tangent<G>& direction : tangents<G>({0.9})) {
      const Tangent<G> x = scale * direction;
      EXPECT_LT(distance(G::template log<double>(exp_of<G>(x)), x), 1e-13 * scale) << scale;
    }
  }
}

TYPED_TEST(LieGroup, AdjointMovesTangentsAcross) {
  using G = TypeParam;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    for (const Tangent<G>& y : tangents<G>({1e-8, 0.7, 2.0})) {
      const Element<G> X = exp_of<G>(x);
      const auto moved = exp_of<G>(G::template Ad<double>(X) * y);
      const auto conjugate =
          G::template compose<double>(G::template compose<double>(X, exp_of<G>(y)), G::template inverse<double>(X));
      EXPECT_LT(distance(moved, conjugate), 5 * kTolerance);
    }
  }
}

TYPED_TEST(LieGroup, AdjointOfTheInverse) {
  using G = TypeParam;
  const Tangent<G> y = tangents<G>({1.3}).front();
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const Element<G> X = exp_of<G>(x);
    const Tangent<G> expected = G::template Ad<double>(G::template inverse<double>(X)) * y;
    EXPECT_LT(distance(G::template Ad_inverse<double>(X, y), expected), kTolerance);
    EXPECT_LT(distance(Tangent<G>(G::template Ad_inverse<double>(X) * y), expected), kTolerance);
  }
}

TYPED_TEST(LieGroup, AdjointIsAHomomorphismAndTheExponentialOfAd) {
  using G = TypeParam;
  const Element<G> Y = exp_of<G>(tangents<G>({1.3}).front());
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const Element<G> X = exp_of<G>(x);
    const Dense<G> Ad = dense<G>(G::template Ad<double>(X));
    EXPECT_LT(distance(dense<G>(G::template Ad<double>(G::template compose<double>(X, Y))),
                       Ad * dense<G>(G::template Ad<double>(Y))),
              kTolerance);
    EXPECT_LT(distance(Ad, power_series<Dense<G>>(dense<G>(G::template ad<double>(x)), 0)), 5 * kTolerance);
  }
}

TYPED_TEST(LieGroup, BracketIsAdAndObeysJacobi) {
  using G = TypeParam;
  const auto points = tangents<G>({0.4, 1.7, 2.9});
  const auto bracket = [](const Tangent<G>& x, const Tangent<G>& y) { return G::template bracket<double>(x, y); };
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Tangent<G>&a = points[i], &b = points[i - 1], &c = points[i / 2];
    EXPECT_LT(distance(bracket(a, b), G::template ad<double>(a) * b), kTolerance);
    EXPECT_EQ(distance(bracket(a, b), -bracket(b, a)), 0.0);
    const Tangent<G> sum = bracket(a, bracket(b, c)) + bracket(b, bracket(c, a)) + bracket(c, bracket(a, b));
    EXPECT_LT(sum.norm(), 10 * kTolerance);
  }
}

TYPED_TEST(LieGroup, LeftJacobianIsItsSeries) {
  using G = TypeParam;
  std::vector<double> angles = nasty_angles();
  angles.push_back(5.0);  // beyond pi
  for (const Tangent<G>& x : tangents<G>(angles)) {
    const Dense<G> series = power_series<Dense<G>>(dense<G>(G::template ad<double>(x)), 1);
    EXPECT_LT(distance(dense<G>(G::template left_jacobian<double>(x)), series), 5 * kTolerance) << x.transpose();
  }
}

TYPED_TEST(LieGroup, LeftJacobianIsTheDerivativeOfExp) {
  using G = TypeParam;
  constexpr double h = 1e-5;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    for (int column = 0; column < G::kDof; ++column) {
      const Tangent<G> step = h * Tangent<G>::Unit(column);
      const auto difference =
          G::template compose<double>(exp_of<G>(x + step), G::template inverse<double>(exp_of<G>(x - step)));
      const Tangent<G> expected = G::template log<double>(difference) / (2 * h);
      const Tangent<G> actual = dense<G>(G::template left_jacobian<double>(x)).col(column);
      EXPECT_LT(distance(actual, expected), 1e-9) << x.transpose() << " column " << column;
    }
  }
}

TYPED_TEST(LieGroup, LeftJacobianInverseUpToPi) {
  using G = TypeParam;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const Operator<G> product = G::template left_jacobian<double>(x) * G::template left_jacobian_inverse<double>(x);
    EXPECT_LT(distance(dense<G>(product), Dense<G>::Identity()), 5 * kTolerance) << x.transpose();
  }
}

TYPED_TEST(LieGroup, LeftAndRightJacobiansDifferByTheAdjoint) {
  using G = TypeParam;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const Operator<G> right = G::template left_jacobian<double>(-x);
    const Operator<G> expected = G::template Ad<double>(exp_of<G>(x)) * right;
    EXPECT_LT(distance(dense<G>(G::template left_jacobian<double>(x)), dense<G>(expected)), 5 * kTolerance);
  }
}

TYPED_TEST(LieGroup, OperatorsCalculateAsTheirMatrices) {
  using G = TypeParam;
  const auto points = tangents<G>({0.3, 2.2});
  const Operator<G> A = G::template left_jacobian<double>(points[0]);
  const Operator<G> B = G::template Ad<double>(exp_of<G>(points[7]));
  const Dense<G> a = dense<G>(A), b = dense<G>(B);
  EXPECT_LT(distance(dense<G>(A * B), a * b), kTolerance);
  EXPECT_LT(distance(dense<G>(A + B), a + b), kTolerance);
  EXPECT_LT(distance(dense<G>(A - B), a - b), kTolerance);
  EXPECT_LT(distance(dense<G>(-A), -a), kTolerance);
  EXPECT_LT(distance(dense<G>(0.3 * A), 0.3 * a), kTolerance);
  Operator<G> sum = A;
  sum += B;
  EXPECT_LT(distance(dense<G>(sum), a + b), kTolerance);
  EXPECT_LT(distance(A * points[3], a * points[3]), kTolerance);
  const Eigen::Matrix<double, 2, G::kDof> rows = Eigen::Matrix<double, 2, G::kDof>::Random();
  EXPECT_LT(distance(rows * A, rows * a), kTolerance);
  EXPECT_EQ(distance(dense<G>(G::template identity_operator<double>()), Dense<G>::Identity()), 0.0);
}

/// x with unit dual parts.
template <class G>
auto dual_tangent(const Tangent<G>& x) {
  using Jet = ceres::Jet<double, G::kDof>;
  Tangent<G, Jet> dual;
  for (int i = 0; i < G::kDof; ++i) dual[i] = Jet(x[i], i);
  return dual;
}

template <class G, class Duals>
Dense<G> derivative(const Duals& y) {
  Dense<G> J;
  for (int i = 0; i < G::kDof; ++i) J.row(i) = y[i].v.transpose();
  return J;
}

TYPED_TEST(LieGroup, DualLogOfExpHasUnitDerivative) {
  using G = TypeParam;
  using Jet = ceres::Jet<double, G::kDof>;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    if (x.template tail<3>().norm() > 3.1415926) continue;
    const auto y = G::template log<Jet>(G::template exp<Jet>(dual_tangent<G>(x)));
    EXPECT_LT(distance(derivative<G>(y), Dense<G>::Identity()), 1e-12) << x.transpose();
  }
}

TYPED_TEST(LieGroup, DualDerivativeOfExpIsTheLeftJacobian) {
  using G = TypeParam;
  using Jet = ceres::Jet<double, G::kDof>;
  for (const Tangent<G>& x : nasty_tangents<G>()) {
    const auto X = G::template exp<Jet>(dual_tangent<G>(x));
    const auto inverse = G::template exp<Jet>((-x).template cast<Jet>());
    const auto y = G::template log<Jet>(G::template compose<Jet>(X, inverse));
    EXPECT_LT(distance(derivative<G>(y), dense<G>(G::template left_jacobian<double>(x))), 1e-12) << x.transpose();
  }
}

}  // namespace
}  // namespace vispline::testing
