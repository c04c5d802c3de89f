#include "vispline/trajectory/cumulative.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include "vispline/trajectory/spline_testing.h"

namespace vispline {
namespace {

using Eigen::Matrix4d;
using testing::random_knots;

Matrix4d matrix(const Pose& X) {
  Matrix4d M = Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = X.R;
  M.topRightCorner<3, 1>() = X.p;
  return M;
}

/// The paper's equations (4)-(6) with 4x4 matrices: T, dT/dt and d^2 T/dt^2. `shift` puts the increments where the
/// text prints them (1) or where they belong (0).
struct PaperSpline {
  Matrix4d T, dT, ddT;
  PaperSpline(const std::array<Matrix4d, 4>& knots, double u, double dt, std::size_t shift = 0) {
    const Eigen::Matrix4d C = (Eigen::Matrix4d() << 6, 0, 0, 0, 5, 3, -3, 1, 1, 3, 3, -2, 0, 0, 0, 1).finished() / 6.0;
    const Eigen::Vector4d B = C * Eigen::Vector4d(1, u, u * u, u * u * u);
    const Eigen::Vector4d dB = C * Eigen::Vector4d(0, 1, 2 * u, 3 * u * u) / dt;
    const Eigen::Vector4d ddB = C * Eigen::Vector4d(0, 0, 2, 6 * u) / (dt * dt);
    std::array<Matrix4d, 3> A, dA, ddA;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = std::min<std::size_t>(j + shift, 2);
      const Matrix4d W = (knots[k].inverse() * knots[k + 1]).log();
      const auto b = static_cast<Eigen::Index>(j + 1);
      A[j] = (W * B(b)).exp();
      dA[j] = A[j] * W * dB(b);
      ddA[j] = dA[j] * W * dB(b) + A[j] * W * ddB(b);
    }
    T = knots[0] * A[0] * A[1] * A[2];
    dT = knots[0] * (dA[0] * A[1] * A[2] + A[0] * dA[1] * A[2] + A[0] * A[1] * dA[2]);
    ddT = knots[0] * (ddA[0] * A[1] * A[2] + A[0] * ddA[1] * A[2] + A[0] * A[1] * ddA[2] +
                      2.0 * (dA[0] * dA[1] * A[2] + dA[0] * A[1] * dA[2] + A[0] * dA[1] * dA[2]));
  }
};

Matrix4d twist_matrix(const Vector6d& xi) {
  Matrix4d M = Matrix4d::Zero();
  M.topLeftCorner<3, 3>() = hat<double>(xi.tail<3>());
  M.topRightCorner<3, 1>() = xi.head<3>();
  return M;
}

TEST(Cumulative, EqualsThePapersEquations4To6) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const double step : {1e-6, 0.1, 0.7}) {
      const auto poses = random_knots<SE3>(seed, 4, step);
      const std::array<Pose, 4> knots{poses[0], poses[1], poses[2], poses[3]};
      const double u = 0.05 * static_cast<double>(seed), dt = 0.1;
      const PaperSpline paper({matrix(knots[0]), matrix(knots[1]), matrix(knots[2]), matrix(knots[3])}, u, dt);
      const auto ours = cumulative_kinematics<SE3, 4, double>(knots, CumulativeBasis<4>(u, dt));
      const Matrix4d T = matrix(ours.X), V = twist_matrix(ours.V), dV = twist_matrix(ours.dV);
      EXPECT_LT((T - paper.T).norm(), 1e-11);
      EXPECT_LT((T * V - paper.dT).norm(), 1e-10 * (1.0 + paper.dT.norm()));
      EXPECT_LT((T * (dV + V * V) - paper.ddT).norm(), 1e-9 * (1.0 + paper.ddT.norm()));
    }
  }
}

TEST(Cumulative, ThePapersPrintedIndicesAreNotTheSpline) {
  const auto poses = random_knots<SE3>(7, 4, 0.5);
  const std::array<Matrix4d, 4> knots{matrix(poses[0]), matrix(poses[1]), matrix(poses[2]), matrix(poses[3])};
  EXPECT_GT((PaperSpline(knots, 0.5, 0.1, 1).T - PaperSpline(knots, 0.5, 0.1, 0).T).norm(), 0.1);
}

template <class G>
class CumulativeLaws : public ::testing::Test {};
using Groups = ::testing::Types<SO3, SE3, SplitPose, Rn<3>>;
TYPED_TEST_SUITE(CumulativeLaws, Groups);

/// Velocity, acceleration and jerk against central differences of the curve, in the body frame.
template <class G, int K>
void expect_kinematics_are_derivatives(double step) {
  using Tangent = typename G::template Tangent<double>;
  const auto knots = random_knots<G>(11, 12, step);
  const Duration spacing = from_seconds(0.1);
  const Spline<G, K> spline(Time{}, spacing, knots);
  const Duration h = from_seconds(1e-4);
  for (const double t : {0.0613, 0.25, 0.4321, 0.5999}) {
    const Time time = Time{} + from_seconds(t);
    const auto at = spline.kinematics(time), before = spline.kinematics(time - h), after = spline.kinematics(time + h);
    const auto difference = [&](const Tangent& a, const Tangent& b) {
      return Tangent((a - b) / (2.0 * to_seconds(h)));
    };
    const Tangent V =
        difference(G::template log<double>(G::template compose<double>(G::template inverse<double>(at.X), after.X)),
                   G::template log<double>(G::template compose<double>(G::template inverse<double>(at.X), before.X)));
    EXPECT_LT((at.V - V).norm(), 2e-6 * (1.0 + at.ddV.norm()));
    EXPECT_LT((at.dV - difference(after.V, before.V)).norm(), 1e-5 * (1.0 + at.ddV.norm()));
    if (K > 4) {
      EXPECT_LT((at.ddV - difference(after.dV, before.dV)).norm(), 1e-3 * (1.0 + at.ddV.norm()));
    }
  }
}

TYPED_TEST(CumulativeLaws, KinematicsAreTheDerivativesOfTheCurve) {
  expect_kinematics_are_derivatives<TypeParam, 4>(0.3);
  expect_kinematics_are_derivatives<TypeParam, 5>(0.3);
  expect_kinematics_are_derivatives<TypeParam, 6>(0.3);
  expect_kinematics_are_derivatives<TypeParam, 4>(1e-6);
}

TYPED_TEST(CumulativeLaws, IsLeftEquivariant) {
  using G = TypeParam;
  const auto knots = random_knots<G>(3, 4, 0.5);
  const auto shift = random_knots<G>(4, 1, 1.0)[0];
  std::array<typename G::template Element<double>, 4> plain, moved;
  for (std::size_t m = 0; m < 4; ++m) {
    plain[m] = knots[m];
    moved[m] = G::template compose<double>(shift, knots[m]);
  }
  const CumulativeBasis<4> basis(0.3, 0.1);
  const auto a = cumulative_kinematics<G, 4, double>(plain, basis);
  const auto b = cumulative_kinematics<G, 4, double>(moved, basis);
  const auto expected = G::template compose<double>(shift, a.X);
  EXPECT_LT(G::template log<double>(G::template compose<double>(G::template inverse<double>(expected), b.X)).norm(),
            1e-12);
  EXPECT_LT((a.V - b.V).norm(), 1e-10);
  EXPECT_LT((a.dV - b.dV).norm(), 1e-8);
}

}  // namespace
}  // namespace vispline
