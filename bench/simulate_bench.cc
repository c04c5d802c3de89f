/// Simulating IMU samples with noise, beside what drawing the same number of normals costs with the standard library.
#include <benchmark/benchmark.h>

#include <random>

#include "vispline/simulate/imu_simulation.h"
#include "vispline/trajectory/analytic.h"

namespace vispline {
namespace {

constexpr double kRate_hz = 200.0;
constexpr Duration kDuration = std::chrono::seconds(500);  // 100,000 samples

void report_per_sample(benchmark::State& state, double samples) {
  using Counter = benchmark::Counter;
  const double total = samples * static_cast<double>(state.iterations());
  state.counters["s_per_sample"] = Counter(total, Counter::kIsRate | Counter::kInvert);
  state.counters["samples_per_s"] = Counter(total, Counter::kIsRate);
}

/// What any simulator has to do at least: 12 normals a sample, one engine, one distribution.
void baseline_12_normals(benchmark::State& state) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (auto _ : state) {
    double sum = 0.0;
    for (int i = 0; i < 12 * 100000; ++i) sum += normal(engine);
    benchmark::DoNotOptimize(sum);
  }
  report_per_sample(state, 100000.0);
}
BENCHMARK(baseline_12_normals)->Unit(benchmark::kMillisecond);

void simulate_samples(benchmark::State& state, const NoiseModel& noise) {
  const Trajectory trajectory = analytic_trajectory("ellipse", Time{}, kDuration).value();
  ImuSimulation simulation;
  simulation.imu.noise = {noise, noise};
  simulation.threads = static_cast<std::size_t>(state.range(0));
  const Stamps stamps(SampleClock{Time{}, kRate_hz}, kDuration);
  for (auto _ : state) {
    simulate_imu(trajectory, simulation, stamps,
                 [](const SimulatedImu& block) { benchmark::DoNotOptimize(block.measured.value.data()); });
  }
  report_per_sample(state, static_cast<double>(stamps.size()));
}

constexpr NoiseModel kWhiteAndWalk{.white = 0.015, .walk = 1e-5};
constexpr NoiseModel kAll{.white = 0.015, .walk = 1e-5, .bias_instability = 1e-4, .quantum = 1e-4, .range = 100.0};
BENCHMARK_CAPTURE(simulate_samples, exact, NoiseModel{})->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulate_samples, white_and_walk, kWhiteAndWalk)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulate_samples, all_noise, kAll)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vispline
