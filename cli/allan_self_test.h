/// How well a record of this rate and length resolves noise: simulate known noise, identify it, compare.
#pragma once

#include <string>

#include "vispline/allan/analysis.h"
#include "vispline/core/noise.h"
#include "vispline/results/json.h"

namespace vispline::cli {

/// What became of one term over all runs.
struct SelfTestRow {
  std::string sensor, term, unit;
  double truth = 0.0;
  int runs = 0, resolved = 0;
  double mean = 0.0, standard_deviation = 0.0;  ///< of the resolved values
  double covered = 0.0;                         ///< share of runs whose 95 % interval (or bound) holds the truth
  double bound = 0.0;                           ///< mean upper bound of the others
};

struct SelfTest {
  double rate_hz = 0.0, duration_s = 0.0;
  std::vector<SelfTestRow> rows;
  double imu_utils_n[2] = {0.0, 0.0}, imu_utils_w[2] = {0.0, 0.0};  ///< mean over the runs: gyroscope, accelerometer
};

SelfTest self_test(const ImuNoise& noise, double rate_hz, double duration_s, int runs, std::uint64_t seed,
                   const AllanOptions& options);
std::string self_test_text(const SelfTest& test);
std::string self_test_json(const SelfTest& test, const JsonContext& context);

}  // namespace vispline::cli
