/// Where simulated samples go: a CSV, a EuRoC folder, or the course's text files.
#pragma once

#include <string>
#include <vector>

#include "vispline/files/output_file.h"
#include "vispline/simulate/imu_simulation.h"

namespace vispline::cli {

struct SimulationTask {
  Trajectory trajectory;
  std::vector<ImuSimulation> imus;
  const Stamps& stamps;
  std::string out, truth;
  OutputOptions output;
};

struct SimulationNames {
  std::string out, truth, format;  ///< format: csv, euroc or course
  std::size_t imus = 1;
};

/// Proves before anything is read that the result can be written.
void probe_simulation(const SimulationNames& names, const OutputOptions& options);

/// Runs the simulation and writes it; `format` is csv, euroc or course.
void write_simulation(const SimulationTask& task, const std::string& format);

}  // namespace vispline::cli
