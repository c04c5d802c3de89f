#include "vispline/integrate/rules.h"

#include <array>
#include <cmath>

#include "vispline/core/error.h"

namespace vispline {
namespace {

using Eigen::Quaterniond;

// The three ways to turn an attitude by the rotation vector theta_b, equations (2)-(4).

/// [1, theta/2] as it is: the norm grows.
Quaterniond turn_raw(const Quaterniond& q, const Vector3d& theta_b) {
  const Vector3d half = 0.5 * theta_b;
  return q * Quaterniond(1.0, half.x(), half.y(), half.z());
}

Quaterniond turn_small(const Quaterniond& q, const Vector3d& theta_b) { return turn_raw(q, theta_b).normalized(); }

Quaterniond turn(const Quaterniond& q, const Vector3d& theta_b) {
  const double angle = theta_b.norm();
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  const Vector3d vec = scale * theta_b;
  return (q * Quaterniond(std::cos(0.5 * angle), vec.x(), vec.y(), vec.z())).normalized();
}

using Turn = Quaterniond (*)(const Quaterniond&, const Vector3d&);

// The two ways to advance position and velocity under a constant acceleration, equations (5) and (6).

void position_first(NavState& state, const Vector3d& a_w, double dt) {
  state.p_w += state.v_w * dt + 0.5 * dt * dt * a_w;
  state.v_w += a_w * dt;
}

/// Adds a dt^2 to the position once too often.
void velocity_first(NavState& state, const Vector3d& a_w, double dt) {
  state.v_w += a_w * dt;
  state.p_w += state.v_w * dt + 0.5 * dt * dt * a_w;
}

using Advance = void (*)(NavState&, const Vector3d& a_w, double dt);

// Rotation vectors of a step, equations (10) and (12).

Vector3d mean_rate(const SampleWindow& window) {
  return 0.5 * window.dt() * (window.first().gyro + window.last().gyro);
}

Vector3d mean_rate_and_coning(const SampleWindow& window) {
  const double dt = window.dt();
  return mean_rate(window) + dt * dt / 12.0 * window.first().gyro.cross(window.last().gyro);
}

using RotationVector = Vector3d (*)(const SampleWindow&);

/// Equations (7)-(9): one sample, the attitude of the beginning.
template <const ImuSample& (SampleWindow::*kSample)() const, Turn kTurn, Advance kAdvance>
NavState euler(const NavState& start, const SampleWindow& window, const Vector3d& g_w) {
  const ImuSample& sample = (window.*kSample)();
  NavState state = start;
  kAdvance(state, start.q_w_b * sample.accel + g_w, window.dt());
  state.q_w_b = kTurn(start.q_w_b, sample.gyro * window.dt());
  return state;
}

/// Equations (10)-(12): both samples, each with the attitude of its own end.
template <RotationVector kTheta, Turn kTurn, Advance kAdvance>
NavState midpoint(const NavState& start, const SampleWindow& window, const Vector3d& g_w) {
  NavState state = start;
  state.q_w_b = kTurn(start.q_w_b, kTheta(window));
  const Vector3d f_w = 0.5 * (start.q_w_b * window.first().accel + state.q_w_b * window.last().accel);
  kAdvance(state, f_w + g_w, window.dt());
  return state;
}

/// Equation (13): each sample with the attitude one step before it, as when both products are taken before the update.
NavState midpoint_lagged(const NavState& start, const SampleWindow& window, const Vector3d& g_w) {
  const auto previous = window.previous();
  const Quaterniond q_w_before = previous ? turn(start.q_w_b, -mean_rate(*previous)) : start.q_w_b;
  const Vector3d f_w = 0.5 * (q_w_before * window.first().accel + start.q_w_b * window.last().accel);
  NavState state = start;
  position_first(state, f_w + g_w, window.dt());
  state.q_w_b = turn(start.q_w_b, mean_rate(window));
  return state;
}

/// d state / dt for a sample, equation (14).
NavState derivative(const NavState& state, const ImuSample& sample, const Vector3d& g_w) {
  const Vector3d half_b = 0.5 * sample.gyro;
  return {state.q_w_b * Quaterniond(0.0, half_b.x(), half_b.y(), half_b.z()), state.v_w,
          state.q_w_b.normalized() * sample.accel + g_w};
}

/// state + h * rate, component by component.
NavState plus(const NavState& state, double h, const NavState& rate) {
  return {Quaterniond(state.q_w_b.coeffs() + h * rate.q_w_b.coeffs()), state.p_w + h * rate.p_w,
          state.v_w + h * rate.v_w};
}

/// The classic fourth-order rule (15) over h seconds, with the samples at the beginning, the middle and the end.
NavState rk4_substep(const NavState& state, const std::array<ImuSample, 3>& samples, double h, const Vector3d& g_w) {
  const NavState k1 = derivative(state, samples[0], g_w);
  const NavState k2 = derivative(plus(state, 0.5 * h, k1), samples[1], g_w);
  const NavState k3 = derivative(plus(state, 0.5 * h, k2), samples[1], g_w);
  const NavState k4 = derivative(plus(state, h, k3), samples[2], g_w);
  NavState end = plus(plus(plus(plus(state, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
  end.q_w_b.normalize();
  return end;
}

/// RK4 whose samples between the stamps lie on the polynomial through kPoints samples (16).
template <std::size_t kPoints, int kSubsteps>
NavState rk4(const NavState& start, const SampleWindow& window, const Vector3d& g_w) {
  NavState state = start;
  for (int i = 0; i < kSubsteps; ++i) {
    const auto sample = [&](double u) { return window.interpolate((i + u) / kSubsteps, kPoints); };
    state = rk4_substep(state, {sample(0.0), sample(0.5), sample(1.0)}, window.dt() / kSubsteps, g_w);
  }
  return state;
}

constexpr auto kFirst = &SampleWindow::first;
constexpr auto kLast = &SampleWindow::last;

constexpr std::array<IntegrationRule, 13> kRules{{
    {"euler_course_2018", "new sample, old attitude, raw quaternion, velocity first", 1,
     euler<kLast, turn_raw, velocity_first>},
    {"euler_course", "new sample, old attitude", 1, euler<kLast, turn_small, position_first>},
    {"euler", "old sample, old attitude: the textbook rule", 1, euler<kFirst, turn, position_first>},
    {"midpoint_course_report", "as printed: raw quaternion, velocity first", 1,
     midpoint<mean_rate, turn_raw, velocity_first>},
    {"midpoint_course_report_position_first", "as printed, but position first", 1,
     midpoint<mean_rate, turn_raw, position_first>},
    {"midpoint_course_report_normalized", "as printed, but normalised", 1,
     midpoint<mean_rate, turn_small, velocity_first>},
    {"midpoint_lagged", "each sample with the attitude one step before it: a common mistake", 1, midpoint_lagged},
    {"midpoint_small_angle", "midpoint with the normalised half-angle quaternion", 2,
     midpoint<mean_rate, turn_small, position_first>},
    {"midpoint", "each sample with the attitude of its own end", 2, midpoint<mean_rate, turn, position_first>},
    {"midpoint_coning", "midpoint with the coning term", 2, midpoint<mean_rate_and_coning, turn, position_first>},
    {"rk4", "Runge-Kutta 4, samples interpolated linearly", 2, rk4<2, 1>},
    {"piecewise_linear_exact", "the exact solution for linearly interpolated samples", 2, rk4<2, 8>},
    {"rk4_cubic", "Runge-Kutta 4, samples interpolated by a cubic", 4, rk4<4, 1>},
}};

std::string list_of_names() {
  std::string text;
  for (const std::string& name : rule_names()) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::span<const IntegrationRule> integration_rules() { return kRules; }

std::vector<std::string> rule_names() {
  std::vector<std::string> names;
  for (const IntegrationRule& rule : kRules) names.emplace_back(rule.name);
  return names;
}

const IntegrationRule& integration_rule(std::string_view name) {
  for (const IntegrationRule& rule : kRules) {
    if (rule.name == name) return rule;
  }
  throw Error(ExitCode::kUsage, {.code = "E-METHOD",
                                 .message = "there is no integration rule " + quoted(name),
                                 .where = "",
                                 .effect = "nothing was integrated",
                                 .next = "choose one of: " + list_of_names()});
}

}  // namespace vispline
