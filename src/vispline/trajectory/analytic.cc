#include "vispline/trajectory/analytic.h"

#include <numbers>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

/// The classic course ellipse, equation (6): 15 m x 20 m in 20 s, ten bounces, small sways.
AnalyticMotion ellipse(const Taylor& t) {
  constexpr double kK = std::numbers::pi / 10.0;  // rad/s
  const Taylor phase = kK * t;
  return {{15.0 * cos(phase) + 5.0, 20.0 * sin(phase) + 5.0, sin(10.0 * phase) + 5.0},
          {0.1 * cos(t), 0.2 * sin(t), phase}};
}

/// Level and at the origin, for noise logs.
AnalyticMotion rest(const Taylor&) { return {}; }

/// Equation (7): straight and level, body x ahead, speed 1 + sin(t/2)/2 m/s.
AnalyticMotion line(const Taylor& t) {
  const Taylor distance = t + 1.0 - cos(0.5 * t);
  return {{0.6 * distance, 0.8 * distance, 0.0}, {0.0, 0.0, std::atan2(0.8, 0.6)}};
}

/// Equation (8): a Gerono lemniscate of 20 m x 10 m in 20 s, body x along the path, banking into the turns.
AnalyticMotion figure_eight(const Taylor& t) {
  constexpr double kRate = std::numbers::pi / 10.0;  // rad/s
  const Taylor phase = kRate * t;
  const Taylor heading = atan2(cos(2.0 * phase), cos(phase));
  return {{10.0 * sin(phase), 5.0 * sin(2.0 * phase), 0.5 * sin(3.0 * phase)},
          {0.2 * sin(phase), 0.1 * cos(3.0 * phase), heading}};
}

/// a sin(sqrt(m) t) + b sin(sqrt(n) t): roots of distinct primes are linearly independent over the rationals.
Taylor two_tones(const Taylor& t, double a, double m, double b, double n) {
  return a * sin(std::sqrt(m) * t) + b * sin(std::sqrt(n) * t);
}

/// Equation (9): a hand-held calibration dance on all six axes, from rest without a jerk, never repeating.
AnalyticMotion dance(const Taylor& t) {
  const Taylor fade_in = t * t / (t * t + 1.0);
  return {{fade_in * two_tones(t, 0.20, 11, 0.05, 31), fade_in * two_tones(t, 0.12, 23, 0.03, 37),
           fade_in * two_tones(t, 0.08, 29, 0.03, 41)},
          {fade_in * two_tones(t, 0.40, 5, 0.20, 17), fade_in * two_tones(t, 0.35, 7, 0.20, 19),
           fade_in * two_tones(t, 0.45, 3, 0.20, 13)}};
}

struct NamedFormula {
  std::string_view name;
  AnalyticFormula formula;
};

constexpr std::array<NamedFormula, 5> kFormulas{
    {{"ellipse", ellipse}, {"static", rest}, {"line", line}, {"figure-eight", figure_eight}, {"dance", dance}}};

using TaylorMatrix = std::array<std::array<Taylor, 3>, 3>;

/// Rz(yaw) Ry(pitch) Rx(roll), equation (4).
TaylorMatrix rotation(const std::array<Taylor, 3>& roll_pitch_yaw) {
  const auto& [roll, pitch, yaw] = roll_pitch_yaw;
  const Taylor sr = sin(roll), cr = cos(roll), sp = sin(pitch), cp = cos(pitch), sy = sin(yaw), cy = cos(yaw);
  const Taylor sy_sp = sy * sp, cy_sp = cy * sp;
  return {{{cy * cp, cy_sp * sr - sy * cr, cy_sp * cr + sy * sr},
           {sy * cp, sy_sp * sr + cy * cr, sy_sp * cr - cy * sr},
           {-sp, cp * sr, cp * cr}}};
}

/// One of the three fields of every entry.
Matrix3d part(const TaylorMatrix& R, double Taylor::*field) {
  Matrix3d A;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A(i, j) = R[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].*field;
  return A;
}

Vector3d part(const std::array<Taylor, 3>& p, double Taylor::*field) { return {p[0].*field, p[1].*field, p[2].*field}; }

}  // namespace

BodyState body_state(const AnalyticMotion& motion) {
  const TaylorMatrix R = rotation(motion.roll_pitch_yaw);
  const Matrix3d R_w_b = part(R, &Taylor::value);
  const Matrix3d R_b_w = R_w_b.transpose();
  return {.R_w_b = R_w_b,
          .p_w = part(motion.p_w, &Taylor::value),
          .v_w = part(motion.p_w, &Taylor::d1),
          .omega_b = vee<double>(R_b_w * part(R, &Taylor::d1)),
          .a_w = part(motion.p_w, &Taylor::d2),
          .alpha_b = vee<double>(R_b_w * part(R, &Taylor::d2))};
}

std::vector<std::string> analytic_names() {
  std::vector<std::string> names;
  for (const NamedFormula& entry : kFormulas) names.emplace_back(entry.name);
  return names;
}

std::optional<Trajectory> analytic_trajectory(std::string_view name, Time start, Duration duration) {
  require(duration >= Duration::zero(), "a trajectory's duration that is not negative");
  for (const NamedFormula& entry : kFormulas) {
    if (entry.name == name) return Trajectory(AnalyticCurve(entry.formula, start, duration));
  }
  return std::nullopt;
}

}  // namespace vispline
