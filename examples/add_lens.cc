/// A lens of one's own: the division model of Fitzgibbon (CVPR 2001) as the distortion of a pinhole.
#include <cmath>
#include <cstdio>

#include "vispline/sensors/lenses/composed.h"
#include "vispline/sensors/lenses/perspective.h"

using namespace vispline;

/// m = d / (1 + lambda |d|^2), solved for d: d = m gain, gain = 2 / (1 + sqrt(1 - 4 lambda |m|^2)).
/// Domain: the root is real. Below 0, lambda is a barrel.
struct Division {
  static constexpr std::array<std::string_view, 1> kParams{"lambda"};

  template <class T>
  static std::optional<Vector2<T>> distort(const T* params, const Vector2<T>& m) {
    using std::sqrt;
    const T inside = T(1) - T(4) * params[0] * m.squaredNorm();
    if (!(inside > T(0))) return std::nullopt;
    return Vector2<T>(T(2) / (T(1) + sqrt(inside)) * m);
  }

  static std::optional<lenses::PlanePoint<2, 1>> linearize(const double* params, const Vector2d& m) {
    const double lambda = params[0], q = m.squaredNorm(), inside = 1.0 - 4.0 * lambda * q;
    if (!(inside > 0.0)) return std::nullopt;
    const double root = std::sqrt(inside), gain = 2.0 / (1.0 + root);
    const double slope = gain * gain / root;  // d gain / d (lambda q)
    lenses::PlanePoint<2, 1> result;
    result.m = gain * m;
    result.d_input = gain * lenses::Matrix2d::Identity() + 2.0 * lambda * slope * m * m.transpose();
    result.d_params = q * slope * m;
    return result;
  }

  static std::optional<Vector2d> undistort(const double* params, const Vector2d& d) {
    const double x = params[0] * d.squaredNorm();
    if (!(x > -1.0 && x < 1.0)) return std::nullopt;  // beyond, d is no image or that of another branch
    return Vector2d(d / (1.0 + x));
  }
};
static_assert(lenses::Distortion<Division>);

using PinholeDivision = lenses::Composed<lenses::Perspective, Division>;  // fu fv pu pv lambda

int main() {
  const double params[] = {460.0, 460.0, 320.0, 240.0, -0.2};
  const Vector3d bearing_c = Vector3d(0.5, -0.3, 0.9).normalized();
  const LensProjection image = PinholeDivision::linearize(params, bearing_c).value();
  const Vector3d back_c = PinholeDivision::unproject(params, image.px).value();

  const double step = 1e-6;
  const double above[] = {460.0, 460.0, 320.0, 240.0, -0.2 + step}, below[] = {460.0, 460.0, 320.0, 240.0, -0.2 - step};
  const Vector2d difference = (PinholeDivision::project<double>(above, bearing_c).value() -
                               PinholeDivision::project<double>(below, bearing_c).value()) /
                              (2.0 * step);
  const double inverse_error = (back_c - bearing_c).norm();
  const double derivative_error = (image.d_params.col(4) - difference).norm();
  std::printf("pixel %.3f %.3f, inverse off by %.1e, d px / d lambda off by %.1e\n", image.px.x(), image.px.y(),
              inverse_error, derivative_error);
  return inverse_error < 1e-12 && derivative_error < 1e-5 && PinholeDivision::param_name(4) == "lambda" ? 0 : 1;
}
