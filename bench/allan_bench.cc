// Overlapping Allan sums of a 3 h, 200 Hz, six-axis log at 93 averaging times, in memory: ours against one pass per tau
// and axis, and against the time of only reading the bytes. Then the whole analysis, exact and in bounded memory.
#include <benchmark/benchmark.h>

#include <numeric>

#include "vispline/allan/analysis.h"
#include "vispline/allan/factors.h"
#include "vispline/allan/overlapping.h"
#include "vispline/core/random.h"

namespace {

using namespace vispline;

constexpr double kRate_hz = 200.0;
constexpr std::int64_t kReadings = 3 * 3600 * 200;

using Axes = std::vector<std::vector<double>>;

Axes random_axes(std::int64_t readings) {
  Axes axes(6);
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const RandomStream stream(1, "axis" + std::to_string(a));
    double bias = 0.0;
    for (std::int64_t i = 0; i < readings; ++i) {
      const auto index = static_cast<std::uint64_t>(i);
      axes[a].push_back(bias + 0.2 * stream.normal(2 * index));
      bias += 3e-6 * stream.normal(2 * index + 1);
    }
  }
  return axes;
}

const Axes& readings() {
  static const Axes axes = random_axes(kReadings);
  return axes;
}

const std::vector<Phase>& phases() {
  static const std::vector<Phase> axes = [] {
    std::vector<Phase> phase;
    for (const auto& axis : readings()) phase.push_back(phase_of(axis, kRate_hz, 0.0));
    return phase;
  }();
  return axes;
}

std::vector<std::int64_t> factors() { return averaging_factors("log", kReadings, Deviation::kOadev); }

void BM_StreamingTheBytes(benchmark::State& state) {
  const std::vector<Phase>& axes = phases();
  for (auto _ : state) {
    double sum = 0.0;
    for (const auto& axis : axes) {
      double part[8] = {};
      for (std::size_t k = 0; k + 8 <= axis.size(); k += 8) {
        for (std::size_t lane = 0; lane < 8; ++lane) part[lane] += axis[k + lane];
      }
      sum += std::accumulate(part, part + 8, 0.0);
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(BM_StreamingTheBytes)->Unit(benchmark::kMillisecond);

void BM_OnePassPerTau(benchmark::State& state) {
  const std::vector<Phase>& axes = phases();
  for (auto _ : state) {
    double sum = 0.0;
    for (const std::int64_t m : factors()) {
      for (const auto& axis : axes) sum += squared_sum(Deviation::kOadev, axis, m).sum;
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(BM_OnePassPerTau)->Unit(benchmark::kMillisecond);

void BM_OverlappingSums(benchmark::State& state) {
  const std::vector<Phase>& axes = phases();
  const std::vector<std::span<const double>> views(axes.begin(), axes.end());
  for (auto _ : state) {
    benchmark::DoNotOptimize(overlapping_sums(views, factors(), static_cast<std::size_t>(state.range(0))));
  }
}
BENCHMARK(BM_OverlappingSums)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void analyse(benchmark::State& state, AllanMemory memory, int days_of_eight) {
  const Axes& axes = readings();
  for (auto _ : state) {
    AllanOptions options;
    options.memory = memory;
    options.threads = 2;
    std::vector<AllanAxis> names;
    for (int a = 0; a < 6; ++a) names.push_back({"gyroscope", std::to_string(a), "rad/s"});
    AllanAnalyzer analyzer(names, options);
    constexpr std::size_t kBlock = 8192;
    for (int repeat = 0; repeat < days_of_eight; ++repeat) {
      for (std::size_t i = 0; i < axes[0].size(); i += kBlock) {
        std::vector<std::span<const double>> views;
        for (const auto& axis : axes) {
          views.push_back(std::span(axis).subspan(i, std::min(kBlock, axis.size() - i)));
        }
        analyzer.push(views);
      }
    }
    benchmark::DoNotOptimize(analyzer.finish(kRate_hz));
  }
}
void BM_AnalysisExact(benchmark::State& state) {
  analyse(state, AllanMemory::kExact, static_cast<int>(state.range(0)));
}
void BM_AnalysisBounded(benchmark::State& state) {
  analyse(state, AllanMemory::kBounded, static_cast<int>(state.range(0)));
}
// 1: 3 h, 8: 24 h.
BENCHMARK(BM_AnalysisExact)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(BM_AnalysisBounded)->Arg(1)->Arg(8)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
