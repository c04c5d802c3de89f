/// The integration table: every rule at every rate, simulated and dead-reckoned beside the truth.
#pragma once

#include <string>
#include <vector>

#include "vispline/results/dead_reckoning_error.h"
#include "vispline/simulate/imu_simulation.h"

namespace vispline::cli {

/// Samples at both ends of the curve: rate x duration + 1 of them.
SimulatedImu simulate_whole(const Trajectory& trajectory, ImuSimulation simulation, double rate_hz);

/// Dead reckoning from the true first state of `samples`, compared with the truth.
Signal<Pose> integrated(const SimulatedImu& samples, const std::string& method, const Vector3d& g_w);

/// One row per method and rate, with observed orders.
std::vector<IntegrationRow> integration_table(const Trajectory& trajectory, const ImuSimulation& simulation,
                                              const std::vector<double>& rates_hz,
                                              const std::vector<std::string>& methods);

}  // namespace vispline::cli
