#include "vispline/trajectory/cumulative_jacobian.h"

#include <gtest/gtest.h>

#include "vispline/trajectory/spline_testing.h"

namespace vispline {
namespace {

using testing::derivatives;
using testing::dual_knots;
using testing::random_knots;

template <class G>
Eigen::MatrixXd dense(const typename G::template Operator<double>& M) {
  return Eigen::Matrix<double, G::kDof, G::kDof>::Identity() * M;
}

double relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).norm() / (1.0 + b.norm()); }

template <class G, int K>
void expect_jacobians(std::uint64_t seed, double step, double u) {
  SCOPED_TRACE(::testing::Message() << "order " << K << " step " << step << " u " << u);
  constexpr int kColumns = K * G::kDof;
  using Jet = ceres::Jet<double, kColumns>;
  using Element = typename G::template Element<double>;
  using Tangent = typename G::template Tangent<double>;
  const double spacing_s = 0.1;
  const auto all = random_knots<G>(seed, K, step);
  std::array<Element, K> knots;
  std::copy(all.begin(), all.end(), knots.begin());
  std::vector<KnotPair<G>> pairs;
  std::array<Tangent, K - 1> d;
  for (std::size_t j = 0; j + 1 < K; ++j) d[j] = pairs.emplace_back(knots[j], knots[j + 1]).d;
  const CumulativeBasis<K> basis(u, spacing_s);
  const CumulativePoint<G, K> point(knots[0], d, basis);
  const auto J = cumulative_jacobian<G, K>(point, pairs.data());

  const auto dual =
      cumulative_kinematics<G, K, Jet>(dual_knots<G, K>(knots), CumulativeBasis<K, Jet>(Jet(u), spacing_s));
  const Element inverse = G::template inverse<double>(point.X);
  const auto eps = G::template log<Jet>(G::template compose<Jet>(inverse.template cast<Jet>(), dual.X));
  const Eigen::MatrixXd dX = derivatives<kColumns>(eps), dV = derivatives<kColumns>(dual.V),
                        ddV = derivatives<kColumns>(dual.dV);
  Eigen::Matrix<double, 2, G::kDof> L_X, L_V, L_dV;
  L_X.setRandom();
  L_V.setRandom();
  L_dV.setRandom();
  const auto pulled = cumulative_pull_back<G, K, 2>(point, pairs.data(), L_X, L_V, L_dV);
  const auto pulled_X = cumulative_pull_back<G, K, 2>(point, pairs.data(), L_X);
  for (int m = 0; m < K; ++m) {
    const auto i = static_cast<std::size_t>(m);
    const auto columns = [&](const Eigen::MatrixXd& M) { return Eigen::MatrixXd(M.middleCols(m * G::kDof, G::kDof)); };
    EXPECT_LT(relative(dense<G>(J.X[i]), columns(dX)), 1e-12) << "dX / d knot " << m;
    EXPECT_LT(relative(dense<G>(J.V[i]), columns(dV)), 1e-12) << "dV / d knot " << m;
    EXPECT_LT(relative(dense<G>(J.dV[i]), columns(ddV)), 1e-12) << "d(dV) / d knot " << m;
    EXPECT_LT(relative(pulled[i], L_X * columns(dX) + L_V * columns(dV) + L_dV * columns(ddV)), 1e-12)
        << "pull back to knot " << m;
    EXPECT_LT(relative(pulled_X[i], L_X * columns(dX)), 1e-12) << "pull back of X alone to knot " << m;
  }
}

template <class G>
class CumulativeJacobians : public ::testing::Test {};
using Groups = ::testing::Types<SO3, SE3, SplitPose, Rn<3>, Rn<6>>;
TYPED_TEST_SUITE(CumulativeJacobians, Groups);

TYPED_TEST(CumulativeJacobians, EqualDualNumbers) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const double step : {0.1, 0.5}) {
      const double u = 0.1 * static_cast<double>(seed) + 0.03;
      expect_jacobians<TypeParam, 4>(seed, step, u);
      expect_jacobians<TypeParam, 5>(seed, step, u);
      expect_jacobians<TypeParam, 6>(seed, step, u);
    }
  }
}

TYPED_TEST(CumulativeJacobians, EqualDualNumbersAtTheCorners) {
  for (const double step : {1e-12, 1e-6, 0.9}) {
    for (const double u : {0.0, 1e-9, 1.0 - 1e-9, 1.0}) expect_jacobians<TypeParam, 4>(5, step, u);
  }
}

/// Dual numbers and the formulas share the recursion; finite differences of the curve itself share nothing.
TEST(CumulativeJacobian, EqualsCentralDifferences) {
  const Duration spacing = from_seconds(0.1);
  const Spline<SE3, 4> spline(Time{}, spacing, random_knots<SE3>(21, 8, 0.4));
  for (const double t : {0.013, 0.1, 0.277, 0.5}) {
    const Time time = Time{} + from_seconds(t);
    const auto place = spline.locate(time);
    const auto basis = spline.basis(place);
    const auto J = spline.jacobian(place, spline.point(place, basis));
    const auto at = spline.kinematics(time);
    const double h = 1e-5;
    for (std::size_t m = 0; m < 4; ++m) {
      for (int i = 0; i < 6; ++i) {
        const auto moved = [&](double sign) {
          Spline<SE3, 4> copy = spline;
          std::vector<Vector6d> delta(copy.knots().size(), Vector6d::Zero());
          delta[place.first + m](i) = sign * h;
          copy.retract(delta);
          return copy.kinematics(time);
        };
        const auto plus = moved(1.0), minus = moved(-1.0);
        const Vector6d dX =
            (SE3::log<double>(at.X.inverse() * plus.X) - SE3::log<double>(at.X.inverse() * minus.X)) / (2.0 * h);
        const auto expect_column = [&](const Vector6d& ours, const Vector6d& theirs, const char* what) {
          EXPECT_LT((ours - theirs).norm(), 1e-7 * (1.0 + theirs.norm())) << what << " knot " << m << " axis " << i;
        };
        expect_column(J.X[m].dense().col(i), dX, "X");
        expect_column(J.V[m].dense().col(i), (plus.V - minus.V) / (2.0 * h), "V");
        expect_column(J.dV[m].dense().col(i), (plus.dV - minus.dV) / (2.0 * h), "dV");
      }
    }
  }
}

}  // namespace
}  // namespace vispline
