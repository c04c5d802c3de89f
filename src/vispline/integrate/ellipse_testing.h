/// Exact IMU samples along an analytic trajectory, and the error of dead reckoning on them. For tests only.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vispline/core/so3.h"
#include "vispline/integrate/dead_reckon.h"
#include "vispline/trajectory/analytic.h"

namespace vispline::testing_support {

inline const Vector3d kGravityW(0.0, 0.0, -9.81);

inline ImuSample exact_sample(const BodyState& state) {
  return {state.omega_b, state.R_w_b.transpose() * (state.a_w - kGravityW)};
}

/// Samples at `times`, all inside the curve.
inline ImuSignal exact_samples(const Trajectory& truth, const std::vector<Time>& times) {
  ImuSignal imu;
  for (const Time time : times) imu.push_back(time, exact_sample(*truth.at(time)));
  return imu;
}

/// Stamps at both ends of a span from 0 and at rate_hz between.
inline std::vector<Time> regular_stamps(double seconds, double rate_hz) {
  const SampleClock clock{Time{}, rate_hz};
  std::vector<Time> times;
  for (std::int64_t i = 0; i <= std::llround(seconds * rate_hz); ++i) times.push_back(clock(i));
  return times;
}

struct ReckoningError {
  double final_m = 0.0, max_m = 0.0, rms_m = 0.0, final_deg = 0.0, max_deg = 0.0;
};

inline ReckoningError reckoning_error(const Trajectory& truth, const std::vector<Time>& times, std::string_view rule) {
  const ImuSignal imu = exact_samples(truth, times);
  const auto states = dead_reckon(imu, nav_state(*truth.at(times.front())), rule, kGravityW);
  ReckoningError error;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState state = *truth.at(states.time[i]);
    const Matrix3d R = state.R_w_b.transpose() * states.value[i].T_w_b().R;
    error.final_m = (states.value[i].p_w - state.p_w).norm();
    error.final_deg = SO3::log<double>(R).norm() * 180.0 / std::numbers::pi;
    error.max_m = std::max(error.max_m, error.final_m);
    error.max_deg = std::max(error.max_deg, error.final_deg);
    error.rms_m += error.final_m * error.final_m / static_cast<double>(states.size());
  }
  error.rms_m = std::sqrt(error.rms_m);
  return error;
}

/// The course's ellipse, 20 s.
inline ReckoningError ellipse_error(std::string_view rule, double rate_hz) {
  const Trajectory ellipse = *analytic_trajectory("ellipse", Time{}, std::chrono::seconds(20));
  return reckoning_error(ellipse, regular_stamps(20.0, rate_hz), rule);
}

}  // namespace vispline::testing_support
