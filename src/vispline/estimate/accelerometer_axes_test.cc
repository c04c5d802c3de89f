#include "vispline/estimate/accelerometer_axes.h"

#include <gtest/gtest.h>

#include "vispline/core/random.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

const Vector3d kGravity_w(0.2, -0.1, -9.8);

/// Held nearly level; one acceleration of twenty is wild.
std::vector<FeltForce> felt_along(const Matrix3d& axes) {
  const RandomStream stream(1, "felt");
  std::vector<FeltForce> felt;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const auto z = [&](std::uint64_t k) { return stream.normal(6 * i + k); };
    const Matrix3d R_w_b = SO3::exp<double>(Vector3d(0.3 * z(0), 0.3 * z(1), z(2)));
    const Vector3d a_w(1.5 * z(3), 1.5 * z(4), z(5));
    const Vector3d f_b = R_w_b.transpose() * (a_w - kGravity_w);
    felt.push_back({R_w_b, i % 20 == 0 ? Vector3d(40.0 * a_w) : a_w, axes.transpose() * f_b});
  }
  return felt;
}

TEST(AccelerometerAxes, AsTheyAre) {
  const AxesChoice choice = accelerometer_axes(felt_along(Matrix3d::Identity()));
  EXPECT_TRUE(choice.axes.isIdentity());
  EXPECT_LT((choice.g_w - kGravity_w).norm(), 1e-9);
}

TEST(AccelerometerAxes, TwoThatHardlySeeGravityAreExchanged) {
  Matrix3d exchanged;
  exchanged << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(accelerometer_axes(felt_along(exchanged)).words, "y, x, z");
}

}  // namespace
}  // namespace vispline
