/// Every sensor with a hand-written `linearize` stands in the list below; standing there is its test.
#include <gtest/gtest.h>

#include <numbers>

#include "vispline/sensors/accelerometer.h"
#include "vispline/sensors/gyroscope.h"
#include "vispline/sensors/jacobian_testing.h"

namespace vispline::testing {
namespace {

using LinearizedSensors = ::testing::Types<Gyroscope, Accelerometer>;

template <class S>
class SensorJacobian : public ::testing::Test {
 protected:
  static void expect_right_at(const Point<S>& point, const std::string& where) {
    const NamedColumns dual = by_dual(point);
    const WorstEntry hand = worst_entry(by_hand(point), dual);
    const WorstEntry difference = worst_entry(by_difference(point), dual);
    EXPECT_LE(hand.relative_error, 1e-12) << S::kName << " linearize at " << where << ", " << hand.text;
    EXPECT_LE(difference.relative_error, 1e-7) << S::kName << " dual at " << where << ", " << difference.text;
  }
};
TYPED_TEST_SUITE(SensorJacobian, LinearizedSensors);

TYPED_TEST(SensorJacobian, GenericPoints) {
  for (std::uint64_t seed = 1; seed <= 250; ++seed) {
    this->expect_right_at(generic_point<TypeParam>(seed), "generic point " + std::to_string(seed));
  }
}

TYPED_TEST(SensorJacobian, Corners) {
  this->expect_right_at({}, "the origin, at rest");
  const Vector3d axis = Vector3d(1.0, -2.0, 0.5).normalized();
  for (const double angle : {1e-12, 1e-5, 1.0, std::numbers::pi - 1e-9, std::numbers::pi}) {
    Point<TypeParam> point = generic_point<TypeParam>(3);
    point.state.R_w_b = SO3::exp<double>(angle * axis);
    point.params.T_b_i.R = SO3::exp<double>(-angle * axis);
    this->expect_right_at(point, "angle " + std::to_string(angle));
  }
  Point<TypeParam> no_lever = generic_point<TypeParam>(4), no_rotation = generic_point<TypeParam>(5);
  no_lever.params.T_b_i.p.setZero();
  no_rotation.state.omega_b.setZero();
  no_rotation.state.alpha_b.setZero();
  this->expect_right_at(no_lever, "no lever arm");
  this->expect_right_at(no_rotation, "no rotation");
}

TYPED_TEST(SensorJacobian, CheckerNamesThePoisonedEntry) {
  const Point<TypeParam> point = generic_point<TypeParam>(1);
  const NamedColumns good = by_dual(point);
  EXPECT_EQ(worst_entry(good, good).text, "all equal");
  int begin = 0;
  for (const auto& [name, width] : good.groups) {
    for (const double poison : {1e-9, std::numeric_limits<double>::quiet_NaN()}) {
      NamedColumns poisoned = good;
      poisoned.values(1, begin + width - 1) += poison;
      const WorstEntry worst = worst_entry(poisoned, good);
      EXPECT_GT(worst.relative_error, 1e-12) << name;
      EXPECT_TRUE(worst.text.starts_with(name + "[1, " + std::to_string(width - 1) + "]")) << worst.text;
    }
    begin += width;
  }
  EXPECT_EQ(begin, good.values.cols());
}

// Wrong models must not pass for sensors.
struct NoTie {
  static constexpr std::string_view kName = "no tie";
  using Sample = Vector3d;
  template <class T>
  struct Params {};
};
struct WrongSize : Accelerometer {
  static constexpr std::array<Block, 5> kBlocks{{{"T_b_i", 12, Space::kSE3, "m, rad"},
                                                 {"scale", 2, Space::kEuclidean, "1"},
                                                 {"misalignment", 6, Space::kEuclidean, "1"},
                                                 {"bias", 4, Space::kEuclidean, "m/s^2"},
                                                 {"time_offset", 1, Space::kEuclidean, "s"}}};
};
struct WrongSpace : Accelerometer {
  static constexpr std::array<Block, 5> kBlocks{{{"T_b_i", 12, Space::kEuclidean, "m, rad"},
                                                 {"scale", 3, Space::kEuclidean, "1"},
                                                 {"misalignment", 6, Space::kEuclidean, "1"},
                                                 {"bias", 3, Space::kEuclidean, "m/s^2"},
                                                 {"time_offset", 1, Space::kEuclidean, "s"}}};
  static constexpr int kParams = tangent_offset(kBlocks, kBlocks.size());
};
static_assert(!HasParams<NoTie> && !Sensor<NoTie>);
static_assert(HasBlocks<WrongSize> && !BlocksMatchParams<WrongSize> && !Sensor<WrongSize>);
static_assert(HasBlocks<WrongSpace> && !BlocksMatchParams<WrongSpace> && !Sensor<WrongSpace>);
static_assert(!HasPredict<int>);

TEST(Block, LayoutOfTheGyroscope) {
  EXPECT_EQ(Gyroscope::kParams, 28);
  EXPECT_EQ(Accelerometer::kParams, 19);
  EXPECT_EQ(tangent_offset(Gyroscope::kBlocks, block_index(Gyroscope::kBlocks, "bias")), 24);
  EXPECT_EQ(block_index(Accelerometer::kBlocks, "g_sensitivity"), Accelerometer::kBlocks.size());
  EXPECT_EQ((Block{"up", 3, Space::kSphere, "1"}.tangent_size()), 2);
  EXPECT_EQ((Block{"R", 9, Space::kSO3, "rad"}.tangent_size()), 3);
}

}  // namespace
}  // namespace vispline::testing
