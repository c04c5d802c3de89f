// One board, one shaken camera, two shutters: writes rolling_shutter.png and global_shutter.png into the folder it is
// given. docs/math/rendering.md, Images.
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>

#include "vispline/core/so3.h"
#include "vispline/files/output_file.h"
#include "vispline/io/png.h"
#include "vispline/simulate/boards.h"
#include "vispline/simulate/box_room.h"
#include "vispline/simulate/render.h"

using namespace vispline;

/// Turns left and right about z, 25 times a second, up to 7.9 rad/s. Body: x right, y forward, z up.
struct Shake {
  TimeSpan span() const { return {Time{}, Time{} + std::chrono::seconds(1)}; }
  BodyState at(Time time) const {
    constexpr double kAngle = 0.05, kRate = 2.0 * std::numbers::pi * 25.0;
    const double phase = kRate * to_seconds(time - Time{});
    BodyState body;
    body.R_w_b = SO3::exp<double>(Vector3d(0.0, 0.0, kAngle * std::sin(phase)));
    body.omega_b = {0.0, 0.0, kAngle * kRate * std::cos(phase)};
    body.alpha_b = {0.0, 0.0, -kAngle * kRate * kRate * std::sin(phase)};
    return body;
  }
};

int pixels_that_differ(const GreyImage& a, const GreyImage& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.grey.size(); ++i) count += std::abs(a.grey[i] - b.grey[i]) > 50;
  return count;
}

int main(int argc, char** argv) {
  Pose T_w_t;  // upright, 1 m ahead
  T_w_t.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  T_w_t.p = {-0.33, 1.0, -0.3};
  Scene scene = box_room({.cell_m = 0.04});
  add_scene(scene, aprilgrid_scene({}, T_w_t));

  Camera camera;
  camera.resolution_px = {480, 360};
  camera.lens.params << 345.0, 345.0, 239.5, 179.5;
  camera.T_c_b.R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  camera.shutter = {.line_delay_s = 30e-3 / 360, .exposure_s = 0.3e-3};
  Camera global = camera;
  global.shutter.line_delay_s = 0.0;
  global.time_offset_s = 15e-3;  // the middle of the readout

  const Trajectory trajectory{Shake{}};
  const Time stamp = Time{} + std::chrono::milliseconds(500 + 10 - 15);  // a turning point in the middle of the readout
  const RenderOptions options{.supersampling = 3, .vignette = 0.25, .read_sigma_grey = 0.0, .threads = 2};
  const GreyImage bent = Renderer(scene, camera, options).render(trajectory, stamp).value();
  const GreyImage straight = Renderer(scene, global, options).render(trajectory, stamp).value();
  if (argc > 1) {
    const std::string folder = argv[1];
    write_file(folder + "/rolling_shutter.png", png_bytes(bent), {.force = true});
    write_file(folder + "/global_shutter.png", png_bytes(straight), {.force = true});
  }
  const int differ = pixels_that_differ(bent, straight);
  std::printf("%d of %zu pixels differ by more than 50 grey levels\n", differ, bent.grey.size());
  return differ > 10000 ? 0 : 1;
}
