// Spline kernels: nanoseconds per evaluation and the ratio to dual numbers, in one run.
//   pose        element of the curve
//   +V, +V+dV   with body velocity and acceleration
//   +J          with the Jacobians of all of these to the K knots
//   dual        the same values and Jacobians through ceres::Jet, one derivative per tangent axis of each knot
// The kernels take turns, and each figure is the median of its turns, so that a busy machine disturbs all alike.
#include <benchmark/benchmark.h>
#include <ceres/jet.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "vispline/core/random.h"
#include "vispline/trajectory/pose_spline.h"

namespace vispline {
namespace {

constexpr int kTurns = 15;
constexpr std::size_t kKnots = 103;
volatile double sink = 0.0;

template <class G, int K>
Spline<G, K> random_spline() {
  const RandomStream stream(1, "bench");
  std::vector<Pose> knots(kKnots);
  for (std::size_t k = 1; k < kKnots; ++k) {
    Vector6d step;
    for (int i = 0; i < 6; ++i) step(i) = (i < 3 ? 0.1 : 0.15) * stream.normal(8 * k + static_cast<std::uint64_t>(i));
    knots[k] = G::template compose<double>(knots[k - 1], G::template exp<double>(step));
  }
  return {Time{}, from_seconds(0.1), knots};
}

/// CPU time of this thread: other processes do not count.
double cpu_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

struct Kernel {
  std::string name;
  std::size_t evaluations;
  std::function<double(Time)> run;
  std::vector<double> ns{};

  double median() const {
    std::vector<double> sorted = ns;
    std::nth_element(sorted.begin(), sorted.begin() + kTurns / 2, sorted.end());
    return sorted[kTurns / 2];
  }
  void turn(const std::vector<Time>& times) {
    const double begin = cpu_ns();
    double sum = 0.0;
    for (std::size_t i = 0; i < evaluations; ++i) sum += run(times[i % times.size()]);
    sink = sink + sum;
    ns.push_back((cpu_ns() - begin) / static_cast<double>(evaluations));
  }
};

/// Values and Jacobians up to kDerivatives, by the analytic forward formulas.
template <class G, int K, int kDerivatives>
double with_jacobians(const Spline<G, K>& spline, Time time) {
  const auto place = spline.locate(time);
  const auto basis = spline.basis(place);
  const auto point = spline.point(place, basis);
  const auto J = cumulative_jacobian<G, K, kDerivatives>(point, &spline.pairs()[place.first]);
  benchmark::DoNotOptimize(J);
  return point.X.p(0);
}

/// The same through dual numbers.
template <class G, int K>
double with_duals(const Spline<G, K>& spline, Time time) {
  using Jet = ceres::Jet<double, 6 * K>;
  const auto place = spline.locate(time);
  std::array<PoseT<Jet>, K> knots;
  for (int m = 0; m < K; ++m) {
    Vector6<Jet> delta;
    for (int i = 0; i < 6; ++i) delta(i) = Jet(0.0, 6 * m + i);
    knots[static_cast<std::size_t>(m)] = G::template compose<Jet>(
        spline.knots()[place.first + static_cast<std::size_t>(m)].template cast<Jet>(), G::template exp<Jet>(delta));
  }
  const auto k = cumulative_kinematics<G, K, Jet>(knots, CumulativeBasis<K, Jet>(Jet(place.u), 0.1));
  benchmark::DoNotOptimize(k);
  return k.X.p(0).a;
}

template <class G, int K>
void report(const char* kind) {
  const Spline<G, K> spline = random_spline<G, K>();
  const PoseSpline<G, K> body(spline);
  const BodyJacobian<6> imu_rows = BodyJacobian<6>::Random();
  const BodyJacobian<2> pixel_rows = BodyJacobian<2>::Random();
  const RandomStream stream(2, "times");
  std::vector<Time> times;
  for (std::uint64_t i = 0; i < 1024; ++i) {
    times.push_back(Time(from_seconds(stream.uniform_pair(i)[0] * 0.999 * spline.span().seconds())));
  }
  const auto values = [&](Time t, int derivatives) {
    const auto place = spline.locate(t);
    const auto basis = spline.basis(place);
    const auto p = spline.point(place, basis);
    return p.X.p(0) + p.V()(0) + (derivatives > 1 ? p.dV()(5) : 0.0);
  };
  std::vector<Kernel> kernels{
      {"pose", 20000, [&](Time t) { return spline.element(t).p(0); }},
      {"pose+J", 10000, [&](Time t) { return with_jacobians<G, K, 0>(spline, t); }},
      {"pose+V", 20000, [&](Time t) { return values(t, 1); }},
      {"pose+V+J", 10000, [&](Time t) { return with_jacobians<G, K, 1>(spline, t); }},
      {"pose+V+dV", 20000, [&](Time t) { return values(t, 2); }},
      {"pose+V+dV+J", 10000, [&](Time t) { return with_jacobians<G, K, 2>(spline, t); }},
      {"pull back, 6 rows", 10000, [&](Time t) { return body.pull_back(t, imu_rows).block[1](5, 5); }},
      {"pull back, 2 rows", 10000, [&](Time t) { return body.pull_back(t, pixel_rows).block[1](1, 5); }},
      {"pose+V+dV+J, dual", 200, [&](Time t) { return with_duals<G, K>(spline, t); }}};
  for (int turn = 0; turn < kTurns; ++turn) {
    for (Kernel& kernel : kernels) kernel.turn(times);
  }
  const double pose = kernels.front().median(), dual = kernels.back().median();
  for (const Kernel& kernel : kernels) {
    std::printf("%-6s %d  %-18s %9.0f ns  %6.2f x pose  dual is %6.1f x this\n", kind, K, kernel.name.c_str(),
                kernel.median(), kernel.median() / pose, dual / kernel.median());
  }
}

}  // namespace
}  // namespace vispline

int main() {
  using namespace vispline;
  report<SE3, 4>("joint");
  report<SE3, 5>("joint");
  report<SE3, 6>("joint");
  report<SplitPose, 4>("split");
  report<SplitPose, 5>("split");
  report<SplitPose, 6>("split");
}
