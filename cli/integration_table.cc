#include "integration_table.h"

#include "console.h"
#include "vispline/integrate/dead_reckon.h"

namespace vispline::cli {

SimulatedImu simulate_whole(const Trajectory& trajectory, ImuSimulation simulation, double rate_hz) {
  const TimeSpan span = trajectory.span();
  simulation.imu.rate_hz = rate_hz;
  return simulate_imu(trajectory, simulation, Stamps({span.begin, rate_hz}, span.end - span.begin + Duration(1)));
}

Signal<Pose> integrated(const SimulatedImu& samples, const std::string& method, const Vector3d& g_w) {
  return poses(dead_reckon(samples.measured, nav_state(samples.body.value.front()), method, g_w));
}

std::vector<IntegrationRow> integration_table(const Trajectory& trajectory, const ImuSimulation& simulation,
                                              const std::vector<double>& rates_hz,
                                              const std::vector<std::string>& methods) {
  std::vector<IntegrationRow> rows(rates_hz.size() * methods.size());
  for (std::size_t r = 0; r < rates_hz.size(); ++r) {
    const SimulatedImu samples = simulate_whole(trajectory, simulation, rates_hz[r]);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      poll_interrupt();
      rows[m * rates_hz.size() + r] = {
          methods[m], rates_hz[r], dead_reckoning_error(integrated(samples, methods[m], simulation.g_w), trajectory),
          std::nullopt};
    }
  }
  fill_observed_orders(rows);
  return rows;
}

}  // namespace vispline::cli
