/// Truncated Taylor numbers: a motion written once as a formula of t yields its velocity and acceleration as well.
/// docs/math/trajectories.md, equations (1)-(3).
#pragma once

#include <cmath>

namespace vispline {

/// A function of time at one instant: its value and its first two time derivatives.
struct Taylor {
  double value = 0.0;
  double d1 = 0.0;  ///< d value / dt
  double d2 = 0.0;  ///< d^2 value / dt^2

  constexpr Taylor() = default;
  constexpr Taylor(double constant) : value(constant) {}  // NOLINT: constants mix with functions in formulas
  constexpr Taylor(double f, double df, double ddf) : value(f), d1(df), d2(ddf) {}

  /// The variable itself: t, with dt/dt = 1.
  static constexpr Taylor time(double t) { return {t, 1.0, 0.0}; }
};

/// h(f) for a scalar h with the given value and derivatives at f.value: the chain rule (2).
constexpr Taylor chain(const Taylor& f, double h, double dh, double ddh) {
  return {h, dh * f.d1, ddh * f.d1 * f.d1 + dh * f.d2};
}

constexpr Taylor operator-(const Taylor& f) { return {-f.value, -f.d1, -f.d2}; }
constexpr Taylor operator+(const Taylor& f, const Taylor& g) { return {f.value + g.value, f.d1 + g.d1, f.d2 + g.d2}; }
constexpr Taylor operator-(const Taylor& f, const Taylor& g) { return {f.value - g.value, f.d1 - g.d1, f.d2 - g.d2}; }
constexpr Taylor operator*(double c, const Taylor& f) { return {c * f.value, c * f.d1, c * f.d2}; }
constexpr Taylor operator*(const Taylor& f, double c) { return c * f; }
constexpr Taylor operator*(const Taylor& f, const Taylor& g) {
  return {f.value * g.value, f.d1 * g.value + f.value * g.d1, f.d2 * g.value + 2.0 * f.d1 * g.d1 + f.value * g.d2};
}
/// Precondition: g.value != 0.
constexpr Taylor operator/(const Taylor& f, const Taylor& g) {
  const double r = 1.0 / g.value;
  return f * chain(g, r, -r * r, 2.0 * r * r * r);
}

inline Taylor sin(const Taylor& f) {
  const double s = std::sin(f.value);
  return chain(f, s, std::cos(f.value), -s);
}
inline Taylor cos(const Taylor& f) {
  const double c = std::cos(f.value);
  return chain(f, c, -std::sin(f.value), -c);
}
/// Precondition: f.value > 0.
inline Taylor sqrt(const Taylor& f) {
  const double r = std::sqrt(f.value);
  return chain(f, r, 0.5 / r, -0.25 / (r * f.value));
}
/// Angle of (x, y) in (-pi, pi]; its derivatives do not see the jump at pi (3). Precondition: (x, y) != 0.
inline Taylor atan2(const Taylor& y, const Taylor& x) {
  const double r2 = x.value * x.value + y.value * y.value;
  const double d1 = (x.value * y.d1 - y.value * x.d1) / r2;
  const double radial = (x.value * x.d1 + y.value * y.d1) / r2;
  return {std::atan2(y.value, x.value), d1, (x.value * y.d2 - y.value * x.d2) / r2 - 2.0 * d1 * radial};
}

}  // namespace vispline
