/// Trajectory + IMU -> what the IMU writes down: exact readings first, then noise. docs/math/imu.md,
/// docs/math/noise.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "vispline/sensors/imu.h"
#include "vispline/sensors/recording.h"
#include "vispline/simulate/stamps.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

/// What to do with stamps at which the trajectory is not defined.
enum class OutsideSpan {
  kError,  ///< simulate nothing
  kSkip,   ///< leave them out and count them
};

struct ImuSimulation {
  Imu imu{};
  Vector3d g_w{0.0, 0.0, -9.81};  ///< m/s^2, gravitational acceleration: points down
  std::uint64_t seed = 0;         ///< the streams depend on the seed and on imu.name only
  std::size_t threads = 1;        ///< does not change a byte of the result
  OutsideSpan outside = OutsideSpan::kError;
  double clock_drift = 0.0;        ///< of the IMU's clock against the body's, sensors/clock.h
  Time clock_start{};              ///< where the two agree but for the time offset
  std::size_t block_size = 16384;  ///< samples handed to the sink at a time; does not change a byte of the result
};

/// Simulated samples: a block of a stream, or all of them. All members have one entry a sample.
struct SimulatedImu {
  ImuSignal measured;            ///< with noise
  std::vector<ImuSample> exact;  ///< predict(): calibration, but no noise
  std::vector<ImuSample> bias;   ///< true bias: the constant one of the calibration + turn-on + walk + flicker
  Signal<BodyState> body;        ///< state of the body at the gyroscope's instant, stamped on the body's clock
  std::size_t outside = 0;       ///< stamps left out because the trajectory is not defined there
};

/// Called with consecutive blocks, on the calling thread; the block is reused after the call returns.
using SimulationSink = std::function<void(const SimulatedImu& block)>;

/// Streams the samples of one IMU, block by block, in memory that does not grow with their number. The trajectory is
/// evaluated at stamp + time_offset + clock_drift (stamp - clock_start) (docs/math/imu.md (1), sensors/clock.h).
/// Returns how many stamps were left out (OutsideSpan::kSkip). Throws Error(kUsage) for an invalid IMU, gravity, or
/// block size of 0, and Error(kUnfit, E-SPAN) if stamps lie outside the trajectory's span (OutsideSpan::kError) or all
/// of them do; then the sink has not been called.
std::size_t simulate_imu(const Trajectory& trajectory, const ImuSimulation& simulation, const Stamps& stamps,
                         const SimulationSink& sink);

/// All samples at once.
SimulatedImu simulate_imu(const Trajectory& trajectory, const ImuSimulation& simulation, const Stamps& stamps);

}  // namespace vispline
