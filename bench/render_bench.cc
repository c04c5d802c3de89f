/// Rendering at 640 x 480: a board in a textured room, global and rolling shutter, with and without motion blur. Beside
/// it the least that any renderer does: one normal a pixel.
#include <benchmark/benchmark.h>

#include "vispline/core/random.h"
#include "vispline/io/png.h"
#include "vispline/simulate/boards.h"
#include "vispline/simulate/box_room.h"
#include "vispline/simulate/render.h"
#include "vispline/trajectory/analytic.h"

namespace vispline {
namespace {

constexpr Duration kDuration = std::chrono::seconds(20);

/// The figure eight with a camera that looks forward and the board on the wall.
Renderer make_renderer(double line_delay_s, double exposure_s, std::size_t threads) {
  Camera camera;
  camera.T_c_b.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  camera.shutter = {.line_delay_s = line_delay_s, .exposure_s = exposure_s};
  Scene scene = box_room({.lower_w = {-13.0, -8.0, -3.0}, .upper_w = {13.0, 8.0, 5.0}});
  Pose T_w_t;
  T_w_t.R << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  T_w_t.p = {12.9, 0.3, 0.0};
  add_scene(scene, aprilgrid_scene({}, T_w_t));
  return Renderer(scene, camera, {.vignette = 0.2, .threads = threads});
}

void report_frames(benchmark::State& state) {
  state.counters["frames_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void render_frames(benchmark::State& state, double line_delay_s, double exposure_s) {
  const Trajectory trajectory = analytic_trajectory("figure-eight", Time{}, kDuration).value();
  const Renderer renderer = make_renderer(line_delay_s, exposure_s, static_cast<std::size_t>(state.range(0)));
  std::int64_t frame = 0;
  for (auto _ : state) {
    const Time stamp = Time{} + std::chrono::milliseconds(100 + 33 * (frame++ % 500));
    benchmark::DoNotOptimize(renderer.render(trajectory, stamp).value().grey.data());
  }
  report_frames(state);
}
BENCHMARK_CAPTURE(render_frames, global, 0.0, 0.0)
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_frames, rolling, 6e-5, 0.0)
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(render_frames, rolling_5_ms_exposure, 6e-5, 5e-3)
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void baseline_noise(benchmark::State& state) {
  const RandomStream stream(1, "noise");
  for (auto _ : state) {
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 640 * 480 / 2; ++i) sum += stream.normal_pair(i)[0];
    benchmark::DoNotOptimize(sum);
  }
  report_frames(state);
}
BENCHMARK(baseline_noise)->Unit(benchmark::kMillisecond);

void png_frames(benchmark::State& state) {
  const Trajectory trajectory = analytic_trajectory("figure-eight", Time{}, kDuration).value();
  const GreyImage image = make_renderer(0.0, 0.0, 2).render(trajectory, Time{} + std::chrono::seconds(5)).value();
  for (auto _ : state) benchmark::DoNotOptimize(png_bytes(image).data());
  report_frames(state);
}
BENCHMARK(png_frames)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vispline
