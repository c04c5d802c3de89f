#include "vispline/sensors/lens.h"

#include <gtest/gtest.h>

#include <numbers>

#include "vispline/core/error.h"
#include "vispline/sensors/lens_testing.h"
#include "vispline/sensors/lenses/positive.h"

namespace vispline::testing {
namespace {

class LensLaw : public ::testing::TestWithParam<LensModel> {};

/// Pixels per radian in the direction that moves the pixel least.
double least_gain(const LensProjection& projection, const Vector3d& bearing_c) {
  const Vector3d u = bearing_c.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> tangent;
  tangent << u, bearing_c.cross(u);
  return Eigen::JacobiSVD<Eigen::Matrix2d>(projection.d_point * tangent).singularValues()[1];
}

TEST_P(LensLaw, UnprojectInvertsProjectOnTheWholeDomain) {
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    const Lens lens = generic_lens(GetParam(), seed % 7);
    Draw draw(seed);
    const Vector3d bearing_c = draw.vector<3>(1.0).normalized();
    const auto projection = lens.linearize(bearing_c);
    ASSERT_EQ(projection.has_value(), lens.project(bearing_c).has_value());
    if (!projection) continue;
    ++inside;
    if (least_gain(*projection, bearing_c) < 5.0) continue;  // at the very edge the inverse is ill-conditioned
    const auto back_c = lens.unproject(projection->px);
    ASSERT_TRUE(back_c) << bearing_c.transpose() << " at px " << projection->px.transpose();
    EXPECT_LE((*back_c - bearing_c).norm(), 1e-10) << bearing_c.transpose();
  }
  EXPECT_GT(inside, 500);
}

TEST_P(LensLaw, ProjectInvertsUnprojectOrThereIsNoDirection) {
  const Lens lens = typical_lens(GetParam());
  int seen = 0;
  for (double x = -1500.0; x <= 2100.0; x += 37.0) {
    for (double y = -1500.0; y <= 2000.0; y += 41.0) {
      const auto bearing_c = lens.unproject({x, y});
      if (!bearing_c) continue;
      ++seen;
      EXPECT_LE(std::abs(bearing_c->norm() - 1.0), 1e-15);
      const auto px = lens.project(*bearing_c);
      ASSERT_TRUE(px) << x << " " << y;
      EXPECT_LE((*px - Vector2d(x, y)).norm(), 1e-8) << x << " " << y;
    }
  }
  EXPECT_GT(seen, 50);
}

TEST_P(LensLaw, OnlyTheDirectionMatters) {
  const Lens lens = typical_lens(GetParam());
  const Vector3d point_c(0.31, -0.22, 0.9);
  const Vector2d px = lens.project(point_c).value();
  EXPECT_LE((lens.project(1e9 * point_c).value() - px).norm(), 1e-10);
  EXPECT_LE((lens.project(1e-9 * point_c).value() - px).norm(), 1e-10);
  EXPECT_LE((lens.linearize(point_c).value().d_point * point_c).norm(), 1e-10);
}

TEST_P(LensLaw, TheAxisIsThePrincipalPointAndNothingIsUndefined) {
  const Lens lens = typical_lens(GetParam());
  const Vector2d centre = lens.project(Vector3d::UnitZ()).value();
  EXPECT_LE((lens.unproject(centre).value() - Vector3d::UnitZ()).norm(), 1e-15);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Vector3d& point_c : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.0, 0.0, -1.0), Vector3d(nan, 0.0, 1.0),
                                  Vector3d(0.0, 0.0, nan), Vector3d(inf, 0.0, 1.0)}) {
    EXPECT_FALSE(lens.project(point_c)) << point_c.transpose();
    EXPECT_FALSE(lens.linearize(point_c)) << point_c.transpose();
  }
  for (const Vector2d& px : {Vector2d(nan, 0.0), Vector2d(0.0, inf)}) {
    EXPECT_FALSE(lens.unproject(px));
    EXPECT_FALSE(lens.linearize_ray(px));
  }
}

TEST_P(LensLaw, NamesAndCountsOfParameters) {
  const LensModel model = GetParam();
  EXPECT_EQ(lens_params(model), typical_lens(model).params.size());
  std::string names;
  for (int i = 0; i < lens_params(model); ++i) names += std::string(lens_param_name(model, i)) + " ";
  EXPECT_NE(names.find("fu fv pu pv"), std::string::npos);
  Lens wrong = typical_lens(model);
  wrong.params = LensParams::Ones(3);
  EXPECT_THROW(wrong.project(Vector3d::UnitZ()), Error);
  EXPECT_THROW(lens_param_name(model, lens_params(model)), Error);
}

INSTANTIATE_TEST_SUITE_P(Models, LensLaw, ::testing::ValuesIn(kLensModels), [](const auto& test) {
  std::string name(lens_name(test.param));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// By Kalibr's and OpenCV's formulas in 40-digit arithmetic, for the parameters of typical_lens().
TEST(Lens, IndependentNumbers) {
  struct Row {
    LensModel model;
    std::array<double, 2> ahead, oblique, behind;  ///< px; {} where the lens has no image
  };
  const Row rows[] = {
      {LensModel::kPinhole, {412.0, 178.533333333333333}, {-242.222222222222222, 598.555555555555556}, {}},
      {LensModel::kPinholeRadtan,
       {457.46276228811522, 188.393389741684835},
       {-42.6771859816574157, 508.639735758225875},
       {}},
      {LensModel::kPinholeEquidistant,
       {292.4228088521018, 231.903115147949198},
       {98.8193590983196013, 356.238170561014774},
       {521.67676788604614, 423.608740130086612}},
      {LensModel::kPinholeFov,
       {368.638624335133895, 207.433268923432088},
       {117.0256776256908, 369.727066908797619},
       {}},
      {LensModel::kOmni,
       {391.47852060090179, 203.90502445166387},
       {65.4087662301230605, 413.825242977531177},
       {818.537041255662253, 551.149879186881679}},
      {LensModel::kOmniRadtan,
       {400.231005810208129, 198.132315027173736},
       {35.3798111110914209, 432.746927887728887},
       {850.622726027041971, 571.130624694201257}},
      {LensModel::kDoubleSphere,
       {359.249754777729654, 213.66995616993969},
       {157.306237201456214, 344.179471973840254},
       {596.176509960918234, 413.689133217608733}},
      {LensModel::kExtendedUnified,
       {372.956148090530201, 204.56514535176868},
       {102.314632270248076, 379.040115347925724},
       {686.396415200166596, 469.845899350104508}},
  };
  for (const Row& row : rows) {
    const Lens lens = typical_lens(row.model);
    const auto expect = [&](const Vector3d& point_c, const std::array<double, 2>& expected) {
      const auto px = lens.project(point_c);
      ASSERT_EQ(px.has_value(), expected[0] != 0.0) << lens_name(row.model);
      if (!px) return;
      EXPECT_LE((*px - Vector2d(expected[0], expected[1])).norm(), 1e-11) << lens_name(row.model);
      EXPECT_LE((lens.unproject({expected[0], expected[1]}).value() - point_c.normalized()).norm(), 1e-13);
    };
    expect({0.3, -0.2, 1.5}, row.ahead);
    expect({-1.1, 0.7, 0.9}, row.oblique);
    expect({0.8, 0.5, -0.1}, row.behind);
  }
}

TEST(Radtan, BeyondTheMonotonicRadiusThereIsNoPixel) {
  // 1 + 3 k1 q + 5 k2 q^2 = 0 at q = (1.2 - sqrt(1.04)) / 0.4 with k1 = -0.4, k2 = 0.04.
  const double limit = std::sqrt((1.2 - std::sqrt(1.44 - 0.8)) / 0.4);
  const Lens lens = make_lens(LensModel::kPinholeRadtan, {100.0, 100.0, 0.0, 0.0, -0.4, 0.04, 0.0, 0.0});
  EXPECT_NEAR(limit, 1.0, 1e-15);
  const double largest_px = 100.0 * (1.0 - 0.4 + 0.04);
  EXPECT_TRUE(lens.project({0.9999999, 0.0, 1.0}));
  EXPECT_FALSE(lens.project({1.0000001, 0.0, 1.0}));
  EXPECT_FALSE(lens.project({3.0, 0.0, 1.0}));  // beyond the second root the polynomial grows again
  EXPECT_LE(lens.unproject({0.999 * largest_px, 0.0}).value().x(), std::sin(std::numbers::pi / 4));
  EXPECT_FALSE(lens.unproject({1.0001 * largest_px, 0.0}));
  EXPECT_FALSE(lens.unproject({500.0, 0.0}));  // the polynomial has a root there, on its outer branch
}

TEST(Radtan, TangentialTermsShrinkTheDomain) {
  // Pure decentring: d_x = x + 3 p2 x^2 on the axis x, which turns at x = -1 / (6 p2).
  const Lens lens = make_lens(LensModel::kPinholeRadtan, {100.0, 100.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1});
  EXPECT_TRUE(lens.project({-1.66, 0.0, 1.0}));
  EXPECT_FALSE(lens.project({-1.67, 0.0, 1.0}));
  const double edge_px = 100.0 * (-1.6 + 0.3 * 1.6 * 1.6);
  EXPECT_NEAR(lens.unproject({edge_px, 0.0}).value().hnormalized().x(), -1.6, 1e-12);
}

TEST(Equidistant, PolynomialThatTurns) {
  // theta_d = theta - theta^3 / 3 turns at theta = 1.
  const Lens lens = make_lens(LensModel::kPinholeEquidistant, {100.0, 100.0, 0.0, 0.0, -1.0 / 3.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(lens.project({std::sin(0.9999999), 0.0, std::cos(0.9999999)}));
  EXPECT_FALSE(lens.project({std::sin(1.0000001), 0.0, std::cos(1.0000001)}));
  EXPECT_FALSE(lens.unproject({66.7, 0.0}));
}

TEST(Positive, OnAnInterval) {
  const auto positive = [](std::array<double, 5> a, double x) { return lenses::positive_on<double>(a, x); };
  EXPECT_TRUE(positive({1.0, -1.0, 0.0, 0.0, 0.0}, 0.999999));
  EXPECT_FALSE(positive({1.0, -1.0, 0.0, 0.0, 0.0}, 1.0));
  EXPECT_TRUE(positive({1.0, -2.0, 1.0 + 1e-9, 0.0, 0.0}, 5.0));  // (1 - s)^2 + 1e-9 s^2
  EXPECT_FALSE(positive({1.0, -2.0, 1.0 - 1e-9, 0.0, 0.0}, 5.0));
  EXPECT_FALSE(positive({1.0, -2.0, 1.0, 0.0, 0.0}, 5.0));   // touched
  EXPECT_FALSE(positive({1.0, 0.0, -2.25, 0.0, 1.0}, 3.0));  // (1 - s^2)(1 - s^2) - s^2 / 4: two roots inside
  EXPECT_FALSE(positive({1.0, 0.0, 0.0, 0.0, 0.0}, std::nan("")));
}

}  // namespace
}  // namespace vispline::testing
