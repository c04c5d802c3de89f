// A log read from disk and dead-reckoned: what `vispline integrate` does, in a page.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "vispline/integrate/dead_reckon.h"
#include "vispline/io/euroc_imu.h"
#include "vispline/io/read.h"
#include "vispline/simulate/imu_simulation.h"
#include "vispline/trajectory/analytic.h"

using namespace vispline;

namespace {

/// Stands for the log of a real IMU: 20 s along the ellipse at 200 Hz, a sample at both ends.
void write_log(const Trajectory& trajectory, const std::string& path) {
  const Stamps stamps(SampleClock{.start = trajectory.span().begin, .rate_hz = 200.0}, Duration(20'000'000'001));
  const ImuSignal imu = simulate_imu(trajectory, ImuSimulation{}, stamps).measured;
  std::string text = std::string(euroc_imu::kHeader) + "\n";
  for (std::size_t i = 0; i < imu.size(); ++i) euroc_imu::append_row(text, imu.time[i], imu.value[i]);
  std::ofstream(path) << text;
}

}  // namespace

int main() {
  const Trajectory truth =
      analytic_trajectory("ellipse", time_from_ns(1403636579763555584), std::chrono::seconds(20)).value();
  const std::string path = (std::filesystem::temp_directory_path() / "vispline_read_and_integrate.csv").string();
  write_log(truth, path);

  const ReadResult<ImuSignal> log = read_imu(path);
  std::filesystem::remove(path);
  std::printf("%lld samples, format %s\n", static_cast<long long>(log.counts.kept), log.format.c_str());

  const NavState start = nav_state(*truth.at(log.value.time.front()));
  const Vector3d g_w(0, 0, -9.81);
  double midpoint_error_m = 0.0;
  for (const std::string_view rule : {"euler", "midpoint", "rk4_cubic"}) {
    const Signal<NavState> states = dead_reckon(log.value, start, rule, g_w);
    const double error_m = (states.value.back().p_w - truth.at(states.time.back())->p_w).norm();
    std::printf("%-10s ends %.3g m off\n", rule.data(), error_m);
    if (rule == "midpoint") midpoint_error_m = error_m;
  }
  const bool as_expected = log.counts.kept == 4001 && 1.28e-3 < midpoint_error_m && midpoint_error_m < 1.29e-3;
  return as_expected ? 0 : 1;
}
