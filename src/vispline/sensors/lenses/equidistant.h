/// The equidistant projection, m = theta (x, y) / |(x, y)| with the angle theta from the axis, for theta < pi, and the
/// radial polynomial of Kannala and Brandt (PAMI 2006) with four terms, as Kalibr and OpenCV's fisheye module have it.
/// docs/math/camera.md (8), (9)
#pragma once

#include "vispline/sensors/lenses/arctangent.h"
#include "vispline/sensors/lenses/newton.h"
#include "vispline/sensors/lenses/positive.h"
#include "vispline/sensors/lenses/stage.h"

namespace vispline::lenses {

struct Equidistant {
  static constexpr std::array<std::string_view, 0> kParams{};

  template <class T>
  static std::optional<Vector2<T>> project(const T*, const Vector3<T>& point_c) {
    using std::atan2, std::sqrt;
    const T rho2 = point_c.x() * point_c.x() + point_c.y() * point_c.y();
    const T& z = point_c.z();
    if (near_axis(rho2, z)) return Vector2<T>(arctangent_ratio<T>(rho2 / (z * z)) / z * point_c.template head<2>());
    if (!(rho2 > T(0))) return std::nullopt;
    const T rho = sqrt(rho2);
    return Vector2<T>(atan2(rho, z) / rho * point_c.template head<2>());
  }

  static std::optional<PlanePoint<3, 0>> linearize(const double*, const Vector3d& point_c) {
    const double rho2 = point_c.head<2>().squaredNorm(), z = point_c.z();
    const double z2 = z * z, distance2 = rho2 + z2;
    double ratio, d_rho2;  // theta / rho and its derivative with respect to rho^2
    if (near_axis(rho2, z)) {
      const double q = rho2 / z2, a = arctangent_ratio(q);
      ratio = a / z;
      d_rho2 = arctangent_ratio_slope(q, a) / (z2 * z);
    } else {
      if (!(rho2 > 0.0)) return std::nullopt;
      const double rho = std::sqrt(rho2);
      ratio = std::atan2(rho, z) / rho;
      d_rho2 = 0.5 * (z / distance2 - ratio) / rho2;
    }
    PlanePoint<3, 0> result;
    result.m = ratio * point_c.head<2>();
    result.d_input.leftCols<2>().noalias() = (2.0 * d_rho2) * point_c.head<2>() * point_c.head<2>().transpose();
    result.d_input(0, 0) += ratio;
    result.d_input(1, 1) += ratio;
    result.d_input.col(2) = point_c.head<2>() / -distance2;
    return result;
  }

  static std::optional<Vector3d> unproject(const double*, const Vector2d& m) {
    const double theta = m.norm();
    if (!(theta < 3.14159265358979)) return std::nullopt;
    const double ratio = theta > 0.0 ? std::sin(theta) / theta : 1.0;
    return Vector3d(ratio * m.x(), ratio * m.y(), std::cos(theta));
  }

 private:
  template <class T>
  static bool near_axis(const T& rho2, const T& z) {
    return z > T(0) && rho2 < T(kArctangentSeries) * z * z;
  }
};

/// d = m (1 + k1 q + k2 q^2 + k3 q^3 + k4 q^4), q = |m|^2. Domain: |d| grows from 0 up to |m|.
struct RadialPolynomial {
  static constexpr std::array<std::string_view, 4> kParams{"k1", "k2", "k3", "k4"};

  template <class T>
  static std::optional<Vector2<T>> distort(const T* k, const Vector2<T>& m) {
    const T q = m.squaredNorm();
    if (!in_domain(k, q)) return std::nullopt;
    return Vector2<T>((T(1) + q * (k[0] + q * (k[1] + q * (k[2] + q * k[3])))) * m);
  }

  static std::optional<PlanePoint<2, 4>> linearize(const double* k, const Vector2d& m) {
    const double q = m.squaredNorm();
    if (!in_domain(k, q)) return std::nullopt;
    const double gain = 1.0 + q * (k[0] + q * (k[1] + q * (k[2] + q * k[3])));
    const double slope = k[0] + q * (2.0 * k[1] + q * (3.0 * k[2] + q * 4.0 * k[3]));
    PlanePoint<2, 4> result;
    result.m = gain * m;
    result.d_input.noalias() = (2.0 * slope) * m * m.transpose();
    result.d_input.diagonal().array() += gain;
    result.d_params.col(0) = q * m;
    for (int i = 1; i < 4; ++i) result.d_params.col(i) = q * result.d_params.col(i - 1);
    return result;
  }

  static std::optional<Vector2d> undistort(const double* k, const Vector2d& d) {
    return undistort_by_newton<RadialPolynomial>(k, d);
  }

 private:
  template <class T>
  static bool in_domain(const T* k, const T& q) {
    return positive_on<T>({T(1), T(3) * k[0], T(5) * k[1], T(7) * k[2], T(9) * k[3]}, q);
  }
};

static_assert(Projection<Equidistant> && Distortion<RadialPolynomial>);

}  // namespace vispline::lenses
