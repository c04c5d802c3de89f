#include "vispline/simulate/rig_simulation.h"

#include <utility>

#include "vispline/simulate/imu_simulation.h"

namespace vispline {

Recording simulate(const Trajectory& trajectory, const Rig& rig, Time start, Duration duration,
                   const RigSimulation& options) {
  require_valid(rig);
  Recording recording;
  for (const Imu& imu : rig.imus) {
    const ImuSimulation simulation{.imu = imu, .g_w = options.g_w, .seed = options.seed, .threads = options.threads};
    const Stamps stamps(SampleClock{start, imu.rate_hz}, duration);
    recording.imus[imu.name] = std::move(simulate_imu(trajectory, simulation, stamps).measured);
  }
  return recording;
}

}  // namespace vispline
