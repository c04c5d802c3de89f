#include "vispline/simulate/rig_simulation.h"

#include <utility>

#include "vispline/simulate/imu_simulation.h"

namespace vispline {

Recording simulate(const Trajectory& trajectory, const Rig& rig, Time start, Duration duration,
                   const RigSimulation& options) {
  require_valid(rig);
  Recording recording;
  for (const Imu& imu : rig.imus) {
    const ClockModel clock = clock_of(options.clocks, imu.name);
    const Duration phase = from_seconds(clock.phase_s);
    const ImuSimulation simulation{.imu = imu,
                                   .g_w = options.g_w,
                                   .seed = options.seed,
                                   .threads = options.threads,
                                   .clock_drift = clock.drift,
                                   .clock_start = start};
    const Stamps stamps(SampleClock{start + phase, imu.rate_hz}, duration - phase);
    recording.imus[imu.name] = std::move(simulate_imu(trajectory, simulation, stamps).measured);
  }
  return recording;
}

Recording simulate(const Trajectory& trajectory, const Rig& rig, const Scene& scene, Time start, Duration duration,
                   const RigSimulation& options) {
  Recording recording = simulate(trajectory, rig, start, duration, options);
  FeatureSimulation features = options.features;
  features.clocks = options.clocks;
  features.seed = options.seed;
  features.threads = options.threads;
  for (const Camera& camera : rig.cameras) recording.features[camera.name];
  simulate_features(trajectory, rig, scene, start, duration, features, [&](const SimulatedFrame& frame) {
    recording.features[rig.cameras[frame.instant.camera].name].push_back(frame.instant.stamp, frame.features);
  });
  return recording;
}

}  // namespace vispline
