// How well noise coefficients are found, as counters: maximum likelihood of the spectrum (vispline allan) against a
// weighted non-negative least-squares fit of the overlapping Allan variances of the same records. Ratios to the truth
// over 48 records of 4 h at 20 Hz.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>

#include "vispline/allan/analysis.h"
#include "vispline/simulate/axis_noise.h"

namespace {

using namespace vispline;

constexpr double kRate_hz = 20.0;
constexpr std::uint64_t kSamples = 14400 * 20;
constexpr std::uint64_t kRecords = 48;

using Mask = std::array<bool, kTerms>;
using Coefficients = std::array<double, kTerms>;

struct Case {
  NoiseModel truth;
  Term slow;  ///< the term beside white noise
  double slow_value;
};

Case case_of(int number) {
  NoiseModel noise{.white = 0.01};
  if (number == 2) {
    noise.bias_instability = 1e-3;
    return {noise, Term::kFlicker, noise.bias_instability};
  }
  noise.walk = number == 0 ? 1e-4 : 5e-5;
  return {noise, Term::kRandomWalk, noise.walk};
}

SignalAnalysis record(const NoiseModel& noise, std::uint64_t seed) {
  AxisNoise axis(noise, seed, "bench");
  std::vector<double> readings;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const AxisNormals normals = axis.normals(i);
    readings.push_back(axis.read(0.0, axis.bias(), normals.white, std::sqrt(kRate_hz)));
    axis.advance(i, normals.walk, 1.0 / kRate_hz);
  }
  AllanAnalyzer analyzer({{"gyroscope", "x", "rad/s"}}, {});
  const std::span<const double> view(readings);
  analyzer.push({&view, 1});
  return analyzer.finish(kRate_hz).signals[0];
}

const std::vector<SignalAnalysis>& records(int number) {
  static std::map<int, std::vector<SignalAnalysis>> made;
  std::vector<SignalAnalysis>& list = made[number];
  for (std::uint64_t seed = list.size() + 1; seed <= kRecords; ++seed) {
    list.push_back(record(case_of(number).truth, seed));
  }
  return list;
}

/// Squared coefficients, not negative, that fit the variances best: the cheapest admissible subset of the terms.
Coefficients non_negative(const Eigen::MatrixXd& basis, const Eigen::VectorXd& target, const Mask& mask) {
  Coefficients best{};
  double least = target.squaredNorm();
  for (unsigned subset = 1; subset < (1u << kTerms); ++subset) {
    std::vector<Eigen::Index> columns;
    bool allowed = true;
    for (unsigned t = 0; t < kTerms; ++t) {
      if (!(subset >> t & 1u)) continue;
      allowed = allowed && mask[t];
      columns.push_back(t);
    }
    if (!allowed) continue;
    const Eigen::VectorXd found = basis(Eigen::all, columns).colPivHouseholderQr().solve(target);
    const double cost = (basis(Eigen::all, columns) * found - target).squaredNorm();
    if (found.minCoeff() < 0.0 || cost >= least) continue;
    least = cost;
    best = {};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      best[static_cast<std::size_t>(columns[k])] = found(static_cast<Eigen::Index>(k));
    }
  }
  return best;
}

/// Weights edf / (2 sigma^4), with sigma^2 of the measured curve and then of the fit.
Coefficients curve_fit(const AllanCurve& curve, const Mask& mask) {
  constexpr int kPasses = 5;
  const auto points = static_cast<Eigen::Index>(curve.tau_s.size());
  Eigen::VectorXd variance(points), model(points);
  Eigen::MatrixXd basis(points, static_cast<Eigen::Index>(kTerms));
  for (Eigen::Index i = 0; i < points; ++i) {
    const auto p = static_cast<std::size_t>(i);
    variance(i) = curve.value[p] * curve.value[p];
    for (std::size_t t = 0; t < kTerms; ++t) {
      const double one = deviation_of(static_cast<Term>(t), 1.0, curve.tau_s[p]);
      basis(i, static_cast<Eigen::Index>(t)) = one * one;
    }
  }
  model = variance;
  Coefficients squares{};
  for (int pass = 0; pass < kPasses; ++pass) {
    const Eigen::VectorXd weight =
        (0.5 * Eigen::Map<const Eigen::VectorXd>(curve.edf.data(), points)).cwiseSqrt().cwiseQuotient(model);
    squares = non_negative(weight.asDiagonal() * basis, weight.cwiseProduct(variance), mask);
    model = basis * Eigen::Map<const Eigen::VectorXd>(squares.data(), static_cast<Eigen::Index>(kTerms));
  }
  for (double& value : squares) value = std::sqrt(value);
  return squares;
}

/// A term that is not resolved counts as 0.
Coefficients likelihood(const SignalAnalysis& signal) {
  Coefficients found{};
  for (std::size_t t = 0; t < kTerms; ++t) found[t] = signal.terms.term[t].value;
  return found;
}

template <class Estimate>
void compare(benchmark::State& state, const Estimate& estimate) {
  const int number = static_cast<int>(state.range(0));
  const Case truth = case_of(number);
  Eigen::Array2d sum = Eigen::Array2d::Zero(), square = sum;
  double zeros = 0.0;
  const std::vector<SignalAnalysis>& all = records(number);
  for (auto _ : state) {
    for (const SignalAnalysis& signal : all) {
      const Coefficients found = estimate(signal, truth);
      const double slow = found[static_cast<std::size_t>(truth.slow)] / truth.slow_value;
      const Eigen::Array2d ratio(found[static_cast<std::size_t>(Term::kWhite)] / truth.truth.white, slow);
      sum += ratio;
      square += ratio.square();
      zeros += slow == 0.0;
    }
  }
  const Eigen::Array2d mean = sum / static_cast<double>(kRecords);
  const Eigen::Array2d scatter = (square / static_cast<double>(kRecords) - mean.square()).max(0.0).sqrt();
  state.counters["N_mean"] = mean(0);
  state.counters["N_scatter"] = scatter(0);
  state.counters["slow_mean"] = mean(1);
  state.counters["slow_scatter"] = scatter(1);
  state.counters["slow_zero"] = zeros;
}

void BM_Likelihood(benchmark::State& state) {
  compare(state, [](const SignalAnalysis& signal, const Case&) { return likelihood(signal); });
}
void BM_CurveFitFiveTerms(benchmark::State& state) {
  compare(state, [](const SignalAnalysis& signal, const Case&) {
    return curve_fit(signal.curves[0], {true, true, true, true, true});
  });
}
/// Told which two terms the record holds.
void BM_CurveFitTrueTerms(benchmark::State& state) {
  compare(state, [](const SignalAnalysis& signal, const Case& truth) {
    Mask mask{false, true, false, false, false};
    mask[static_cast<std::size_t>(truth.slow)] = true;
    return curve_fit(signal.curves[0], mask);
  });
}
// 0: N 0.01, K 1e-4. 1: N 0.01, K 5e-5. 2: N 0.01, B 1e-3.
BENCHMARK(BM_Likelihood)->DenseRange(0, 2)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_CurveFitFiveTerms)->DenseRange(0, 2)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_CurveFitTrueTerms)->DenseRange(0, 2)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
