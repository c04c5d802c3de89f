/// What a look at one signal of a file tells: rhythm, units, ranges, losses. IMU samples in constant memory.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/io/imu_stream.h"
#include "vispline/io/rhythm.h"

namespace vispline {

struct AxisSurvey {
  double mean = 0.0, standard_deviation = 0.0, min = 0.0, max = 0.0;
};

struct ImuSurvey {
  ImuAxes axes;
  std::array<AxisSurvey, kImuAxes> axis;  ///< rad/s, m/s^2; of those that are present
  std::optional<double> median_gyro;      ///< of the norm, rad/s
  std::optional<double> median_accel;     ///< of the norm, m/s^2
};

struct PoseSurvey {
  Vector3d min_w = Vector3d::Zero(), max_w = Vector3d::Zero();  ///< of the positions, m
  double path_length = 0.0;                                     ///< through all positions, m
};

/// One signal. With an `error` the rest stands for what was read before it.
struct SignalSurvey {
  std::string name;    ///< topic or sensor; empty for a table
  std::string format;  ///< kName, or the type of the messages
  ReadCounts counts;
  Diagnostics diagnostics;
  std::int64_t late = 0;            ///< samples that came out of order
  std::optional<StampDelay> delay;  ///< of messages
  Rhythm rhythm;                    ///< of the samples that are kept
  std::optional<ImuSurvey> imu;
  std::optional<PoseSurvey> poses;
  std::optional<Error> error;  ///< why no other verb would read it
};

SignalSurvey survey_imu(const std::string& path, const ReadOptions& options, const ReadProgress& progress = {});
SignalSurvey survey_poses(const std::string& path, const ReadOptions& options);

/// Every signal of a text table, a folder of sensors or the recording of a device: IMU samples, poses or both. Throws
/// what the readers throw for a file that holds neither.
std::vector<SignalSurvey> survey_tables(const std::string& path, const ReadOptions& options,
                                        const ReadProgress& progress = {});

}  // namespace vispline
