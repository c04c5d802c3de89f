/// A turning camera before upright boards, shared by the tests of rendering.
#pragma once

#include "vispline/core/so3.h"
#include "vispline/simulate/render.h"

namespace vispline {

inline constexpr double kDelay_s = 30e-3 / 480;
inline const Time kStamp = time_from_ns(1'000'000'000);

/// A body that turns about a fixed axis by rate t + acceleration t^2 / 2 and flies straight on; t = 0 in the middle of
/// the readout of a frame with kDelay_s.
struct Turn {
  Vector3d rate = Vector3d::Zero(), acceleration = Vector3d::Zero(), v_w = Vector3d::Zero();
  TimeSpan span() const { return {kStamp - std::chrono::seconds(1), kStamp + std::chrono::seconds(1)}; }
  BodyState at(Time time) const {
    const double t = to_seconds(time - kStamp) - 240 * kDelay_s;
    BodyState body;
    body.R_w_b = SO3::exp<double>(rate * t + 0.5 * t * t * acceleration);
    body.omega_b = rate + t * acceleration;
    body.p_w = t * v_w;
    body.v_w = v_w;
    return body;
  }
};

/// Body: x right, y forward, z up, as the world.
inline Camera camera_forward() {
  Camera camera;
  camera.T_c_b.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.shutter.line_delay_s = kDelay_s;
  return camera;
}

/// A board that stands upright, point 0 at (x, y, z).
inline Pose upright(double x, double y, double z) {
  Pose T_w_t;
  T_w_t.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T_w_t.p = {x, y, z};
  return T_w_t;
}

inline constexpr RenderOptions kNoiseless{.read_sigma_grey = 0.0};
inline constexpr RenderOptions kFine{.supersampling = 8,
                                     .read_sigma_grey = 0.0};  // rims of boards fall between few rays

inline GreyImage picture(const Scene& scene, const Camera& camera, const Turn& turn, const RenderOptions& options) {
  return Renderer(scene, camera, options).render(Trajectory(turn), kStamp).value();
}

}  // namespace vispline
