// A new integration rule in one function: attitude at the middle of the step. docs/extending.md, "An integration rule".
#include <cmath>
#include <cstdio>

#include "vispline/core/so3.h"
#include "vispline/integrate/rules.h"
#include "vispline/simulate/imu_simulation.h"
#include "vispline/trajectory/analytic.h"

using namespace vispline;

/// Turns by the mean rate, and turns the mean specific force with the attitude halfway. Order 2.
NavState middle_attitude(const NavState& start, const SampleWindow& window, const Vector3d& g_w) {
  const double dt = window.dt();
  const Vector3d theta_b = 0.5 * dt * (window.first().gyro + window.last().gyro);
  const Matrix3d R_w_b = start.q_w_b.toRotationMatrix();
  const Matrix3d R_w_middle = R_w_b * SO3::exp<double>(0.5 * theta_b);
  const Vector3d a_w = R_w_middle * (0.5 * (window.first().accel + window.last().accel)) + g_w;

  NavState end;
  end.q_w_b = Eigen::Quaterniond(R_w_b * SO3::exp<double>(theta_b)).normalized();  // or rounding grows
  end.p_w = start.p_w + dt * start.v_w + 0.5 * dt * dt * a_w;
  end.v_w = start.v_w + dt * a_w;
  return end;
}

// The line that would stand in the table of integrate/rules.cc.
constexpr IntegrationRule kRule{"middle_attitude", "mean of the samples at the attitude halfway", 2, middle_attitude};

double final_error_m(double rate_hz) {
  const Duration duration = std::chrono::seconds(10);
  const Trajectory truth = analytic_trajectory("figure-eight", Time{}, duration).value();
  const Stamps stamps(SampleClock{.start = Time{}, .rate_hz = rate_hz}, duration);
  const ImuSignal imu = simulate_imu(truth, ImuSimulation{}, stamps).measured;

  NavState state = nav_state(*truth.at(imu.time.front()));
  for (std::size_t i = 0; i + 1 < imu.size(); ++i) {
    state = kRule.step(state, SampleWindow(imu, i), Vector3d(0, 0, -9.81));
  }
  return (state.p_w - truth.at(imu.time.back())->p_w).norm();
}

int main() {
  const double coarse_m = final_error_m(100.0), fine_m = final_error_m(400.0);
  const double order = std::log(coarse_m / fine_m) / std::log(4.0);
  std::printf("%s: %.3g m at 100 Hz, %.3g m at 400 Hz, order %.2f\n", kRule.name.data(), coarse_m, fine_m, order);
  return std::abs(order - kRule.order) < 0.1 ? 0 : 1;
}
