// A new curve in one struct: a helix, simulated like any other trajectory. docs/extending.md, "A trajectory".
#include <cmath>
#include <cstdio>

#include "vispline/simulate/imu_simulation.h"
#include "vispline/trajectory/trajectory.h"

using namespace vispline;

/// Climbs at constant speed around the z axis; x_b points along the horizontal tangent, z_b up.
class Helix {
 public:
  Helix(Time start, Duration duration) : span_{start, start + duration} {}

  TimeSpan span() const { return span_; }

  /// All six members are exact derivatives of one another: the pose is the only thing one may choose.
  BodyState at(Time time) const {
    const double t = to_seconds(time - span_.begin);
    const double s = std::sin(kOmega * t), c = std::cos(kOmega * t);
    BodyState state;
    state.p_w = {kRadius * c, kRadius * s, kClimb * t};
    state.v_w = {-kRadius * kOmega * s, kRadius * kOmega * c, kClimb};
    state.a_w = {-kRadius * kOmega * kOmega * c, -kRadius * kOmega * kOmega * s, 0.0};
    state.R_w_b << -s, -c, 0.0, c, -s, 0.0, 0.0, 0.0, 1.0;
    state.omega_b = {0.0, 0.0, kOmega};
    return state;
  }

 private:
  static constexpr double kRadius = 2.0;  // m
  static constexpr double kOmega = 0.5;   // rad/s
  static constexpr double kClimb = 0.3;   // m/s
  TimeSpan span_;
};

int main() {
  const Duration duration = std::chrono::seconds(20);
  const Trajectory trajectory(Helix(Time{}, duration));

  const Stamps stamps(SampleClock{.start = Time{}, .rate_hz = 200.0}, duration);
  const SimulatedImu imu = simulate_imu(trajectory, ImuSimulation{}, stamps);
  const ImuSample& last = imu.measured.value.back();
  std::printf("%zu samples; last: gyro (%.3f, %.3f, %.3f) rad/s, accel (%.3f, %.3f, %.3f) m/s^2\n", imu.measured.size(),
              last.gyro.x(), last.gyro.y(), last.gyro.z(), last.accel.x(), last.accel.y(), last.accel.z());

  // The centripetal acceleration r omega^2 = 0.5 m/s^2 points to the axis, which is to the left; gravity pulls down.
  const bool as_expected = imu.measured.size() == 4000 && (last.gyro - Vector3d(0, 0, 0.5)).norm() < 1e-12 &&
                           (last.accel - Vector3d(0, 0.5, 9.81)).norm() < 1e-12;
  return as_expected ? 0 : 1;
}
