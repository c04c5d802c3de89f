/// The FOV distortion of Devernay and Faugeras (2001), Kalibr's "fov": one parameter w, rad. docs/math/camera.md (10)
///   |d| = atan(2 |m| tan(w/2)) / w
/// Domain: all m; |d| stays below pi / (2 w). With w = 0 it is the identity.
#pragma once

#include "vispline/sensors/lenses/arctangent.h"
#include "vispline/sensors/lenses/stage.h"

namespace vispline::lenses {

struct Fov {
  static constexpr std::array<std::string_view, 1> kParams{"w"};

  template <class T>
  static std::optional<Vector2<T>> distort(const T* params, const Vector2<T>& m) {
    using std::abs;
    const T& w = params[0];
    if (!(abs(w) < T(kLargest))) return std::nullopt;
    const T c = tangent_ratio<T>(T(0.5) * w);  // 2 tan(w/2) / w
    return Vector2<T>(c * arctangent_ratio<T>(c * c * w * w * m.squaredNorm()) * m);
  }

  static std::optional<PlanePoint<2, 1>> linearize(const double* params, const Vector2d& m) {
    const double w = params[0];
    if (!(std::abs(w) < kLargest)) return std::nullopt;
    const double c = tangent_ratio(0.5 * w), d_c = tangent_ratio_slope(0.5 * w, c), r2 = m.squaredNorm();
    const double a = c * w, d_a = 1.0 + 0.25 * a * a;  // 2 tan(w/2) and its derivative
    const double q = a * a * r2, s = arctangent_ratio(q), d_s = arctangent_ratio_slope(q, s);
    PlanePoint<2, 1> result;
    result.m = (c * s) * m;
    result.d_input.noalias() = (2.0 * c * d_s * a * a) * m * m.transpose();
    result.d_input.diagonal().array() += c * s;
    result.d_params = (d_c * s + c * d_s * 2.0 * a * d_a * r2) * m;
    return result;
  }

  static std::optional<Vector2d> undistort(const double* params, const Vector2d& d) {
    const double w = params[0], angle = std::abs(w) * d.norm();
    if (!(std::abs(w) < kLargest && angle < 1.5707963267948966)) return std::nullopt;
    return Vector2d(tangent_ratio(angle) / tangent_ratio(0.5 * w) * d);
  }

 private:
  static constexpr double kLargest = 3.14159;  ///< of w, which is an angle of view below pi

  /// tan(h) / h.
  template <class T>
  static T tangent_ratio(const T& h) {
    using std::abs, std::tan;
    if (abs(h) > T(kSeries)) return tan(h) / h;
    const T x = h * h;
    T sum = T(kTangent[6]);
    for (int n = 5; n >= 0; --n) sum = sum * x + T(kTangent[n]);
    return sum;
  }

  /// d tangent_ratio(w/2) / dw at h = w/2, given the ratio.
  static double tangent_ratio_slope(double h, double ratio) {
    if (std::abs(h) > kSeries) return 0.5 * (1.0 + h * h * ratio * ratio - ratio) / h;
    const double x = h * h;
    double sum = 6.0 * kTangent[6];
    for (int n = 5; n >= 1; --n) sum = sum * x + n * kTangent[n];
    return h * sum;
  }

  static constexpr double kSeries = 0.05;
  static constexpr double kTangent[7] = {1.0,           1.0 / 3.0,         2.0 / 15.0,         17.0 / 315.0,
                                         62.0 / 2835.0, 1382.0 / 155925.0, 21844.0 / 6081075.0};
};

static_assert(Distortion<Fov>);

}  // namespace vispline::lenses
