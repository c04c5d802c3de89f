#include "vispline/trajectory/spline.h"

#include <gtest/gtest.h>

#include "vispline/trajectory/spline_testing.h"

namespace vispline {
namespace {

using testing::random_knots;

const Time kBegin = time_from_ns(1520530308181901469);
const Duration kSpacing(100'000'003);

Spline<SE3, 4> example() { return {kBegin, kSpacing, random_knots<SE3>(1, 10, 0.3)}; }

TEST(Spline, CoversExactlyTheStatedSpan) {
  const auto spline = example();
  EXPECT_EQ(spline.span().begin, kBegin);
  EXPECT_EQ(spline.span().end, kBegin + 7 * kSpacing);
  EXPECT_EQ((Spline<SE3, 4>::knots_for(from_seconds(12.86), from_seconds(0.1))), 132u);
}

TEST(Spline, GivesAnInstantOnAKnotToTheSegmentItBegins) {
  const auto spline = example();
  for (std::int64_t k = 0; k < 7; ++k) {
    const auto place = spline.locate(kBegin + k * kSpacing);
    EXPECT_EQ(place.first, static_cast<std::size_t>(k));
    EXPECT_EQ(place.u, 0.0);
    const auto before = spline.locate(kBegin + (k + 1) * kSpacing - Duration(1));
    EXPECT_EQ(before.first, static_cast<std::size_t>(k));
    EXPECT_LT(before.u, 1.0);
  }
  const auto end = spline.locate(spline.span().end);
  EXPECT_EQ(end.first, 6u);
  EXPECT_EQ(end.u, 1.0);
}

TEST(Spline, IsC2AtEveryKnot) {
  const auto spline = example();
  for (std::size_t k = 1; k < 7; ++k) {
    const CumulativeBasis<4> left({1.0, to_seconds(kSpacing)}), right({0.0, to_seconds(kSpacing)});
    const auto a = spline.point({k - 1, 1.0}, left);
    const auto b = spline.point({k, 0.0}, right);
    EXPECT_LT(SE3::log<double>(a.X.inverse() * b.X).norm(), 1e-13);
    EXPECT_LT((a.V() - b.V()).norm(), 1e-11 * (1.0 + a.V().norm()));
    EXPECT_LT((a.dV() - b.dV()).norm(), 1e-11 * (1.0 + a.dV().norm()));
    EXPECT_GT((a.ddV() - b.ddV()).norm(), 1.0) << "a cubic spline has a jump in its third derivative";
  }
}

TEST(Spline, ConstantIncrementsAreAConstantTwist) {
  Vector6d increment;
  increment << 0.1, -0.2, 0.05, 0.3, 0.1, -0.2;
  std::vector<Pose> knots(8);
  for (std::size_t k = 1; k < knots.size(); ++k) knots[k] = knots[k - 1] * SE3::exp<double>(increment);
  const Spline<SE3, 5> spline(Time{}, from_seconds(0.1), knots);
  for (const double t : {0.0, 0.123, 0.4}) {
    const auto at = spline.kinematics(Time{} + from_seconds(t));
    EXPECT_LT((at.V - increment / 0.1).norm(), 1e-12);
    EXPECT_LT(at.dV.norm(), 1e-9);
    // Knot k sits at (k - 1.5) spacing for order 5.
    EXPECT_LT(SE3::log<double>(SE3::exp<double>(increment * (t / 0.1 + 1.5)).inverse() * at.X).norm(), 1e-12);
  }
}

TEST(Spline, ReproducesCubicPolynomialsOnVectors) {
  // Marsden: the cubic p(t) = t^3 has B-spline coefficients (t_k - h) t_k (t_k + h) at t_k.
  const double h = 0.1;
  std::vector<Eigen::Matrix<double, 1, 1>> knots;
  for (int k = 0; k < 9; ++k) {
    const double t = (k - 1) * h;
    knots.emplace_back((t - h) * t * (t + h));
  }
  const Spline<Rn<1>, 4> spline(Time{}, from_seconds(h), knots);
  for (const double t : {0.0, 0.05, 0.31, 0.6}) {
    const auto at = spline.kinematics(Time{} + from_seconds(t));
    EXPECT_NEAR(at.X(0), t * t * t, 1e-15);
    EXPECT_NEAR(at.V(0), 3 * t * t, 1e-13);
    EXPECT_NEAR(at.dV(0), 6 * t, 1e-11);
    EXPECT_NEAR(at.ddV(0), 6.0, 1e-9);
  }
}

TEST(Spline, RefusesTooFewKnotsAndZeroSpacing) {
  EXPECT_THROW((Spline<SE3, 4>(kBegin, kSpacing, random_knots<SE3>(1, 3, 0.1))), Error);
  EXPECT_THROW((Spline<SE3, 4>(kBegin, Duration(0), random_knots<SE3>(1, 8, 0.1))), Error);
}

}  // namespace
}  // namespace vispline
