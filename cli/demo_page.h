/// The pages of the demo's report: calibration of a phone, its noise, motion, instrument, what integration costs.
#pragma once

#include <vector>

#include "demo_loop.h"
#include "vispline/report/html_page.h"
#include "vispline/results/dead_reckoning_error.h"
#include "vispline/simulate/imu_simulation.h"

namespace vispline::cli {

/// Position error over time of one integration rule.
struct ErrorCurve {
  std::string method;
  std::vector<double> time_s, error_m;
};

struct DemoResult {
  std::string trajectory;
  ImuSimulation simulation{};                ///< with noise
  SimulatedImu samples{};                    ///< with noise, at simulation.imu.rate_hz
  std::vector<IntegrationRow> exact_rows{};  ///< noise-free, several rates
  std::vector<ErrorCurve> exact{}, noisy{};  ///< at simulation.imu.rate_hz
};

report::Page demo_page(const DemoResult& demo, const DemoLoop& loop, const report::Provenance& provenance);

}  // namespace vispline::cli
