#include "vispline/results/dead_reckoning_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

/// Turns about z at 0.1 rad/s and moves along x at 2 m/s, for 10 s.
struct Cruise {
  TimeSpan span() const { return {time_from_ns(0), time_from_ns(10'000'000'000)}; }
  BodyState at(Time time) const {
    const double t = to_seconds(time - Time{});
    BodyState state;
    state.R_w_b = SO3::exp<double>(Vector3d(0.0, 0.0, 0.1 * t));
    state.p_w = Vector3d(2.0 * t, 0.0, 1.0);
    return state;
  }
};

Pose off_by(double t, const Vector3d& position_m, double tilt_rad) {
  const BodyState state = Cruise().at(Time(from_seconds(t)));
  return {state.R_w_b * SO3::exp<double>(Vector3d(tilt_rad, 0.0, 0.0)), state.p_w + position_m};
}

TEST(DeadReckoningError, HandComputed) {
  Signal<Pose> poses;
  const double degree = std::numbers::pi / 180.0;
  poses.push_back(Time(from_seconds(0.0)), off_by(0.0, Vector3d::Zero(), 0.0));
  poses.push_back(Time(from_seconds(4.0)), off_by(4.0, Vector3d(0.0, 3.0, 4.0), -2.0 * degree));
  poses.push_back(Time(from_seconds(10.0)), off_by(10.0, Vector3d(1.0, 0.0, 0.0), 0.5 * degree));
  poses.push_back(Time(from_seconds(11.0)), off_by(11.0, Vector3d(100.0, 0.0, 0.0), 1.0));
  const DeadReckoningError error = dead_reckoning_error(poses, Trajectory(Cruise()));
  EXPECT_NEAR(error.final_error_m, 1.0, 1e-12);
  EXPECT_NEAR(error.max_error_m, 5.0, 1e-12);
  EXPECT_NEAR(error.rmse_m, std::sqrt(26.0 / 3.0), 1e-12);
  EXPECT_NEAR(error.attitude_error_deg, 2.0, 1e-10);
  EXPECT_EQ(error.samples, 3);
  EXPECT_EQ(error.outside, 1);
}

TEST(DeadReckoningError, NoCommonTime) {
  Signal<Pose> poses;
  poses.push_back(Time(from_seconds(20.0)), Pose{});
  try {
    dead_reckoning_error(poses, Trajectory(Cruise()));
    FAIL() << "expected E-OVERLAP";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostic().code, "E-OVERLAP");
  }
  EXPECT_THROW(dead_reckoning_error({}, Trajectory(Cruise())), Error);
}

IntegrationRow row(const std::string& method, double rate_hz, double max_error_m) {
  IntegrationRow result{.method = method, .rate_hz = rate_hz, .error = {}, .order = 9.0};
  result.error.max_error_m = max_error_m;
  return result;
}

TEST(ObservedOrder, PairsEachRateWithTheNextLowerOneOfItsMethod) {
  std::vector<IntegrationRow> rows = {row("euler", 400.0, 0.1),   row("rk4", 100.0, 0.04), row("euler", 100.0, 0.4),
                                      row("rk4", 1000.0, 0.0004), row("rk4", 200.0, 0.01), row("exact", 100.0, 0.0),
                                      row("exact", 200.0, 0.0)};
  fill_observed_orders(rows);
  EXPECT_NEAR(*rows[0].order, 1.0, 1e-12);
  EXPECT_FALSE(rows[1].order);
  EXPECT_FALSE(rows[2].order);
  EXPECT_NEAR(*rows[3].order, 2.0, 1e-12);
  EXPECT_NEAR(*rows[4].order, 2.0, 1e-12);
  EXPECT_FALSE(rows[5].order);
  EXPECT_FALSE(rows[6].order);  // 0/0 has no order
  EXPECT_EQ(rows[3].method, "rk4");
}

}  // namespace
}  // namespace vispline
