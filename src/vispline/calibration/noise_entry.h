/// What a parameter file says about the noise of one IMU. Continuous time (densities), SI. docs/calibration-files.md.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace vispline {

/// A bias random walk, as far as a record resolves it: its value, else an upper bound, else nothing at all.
struct WalkEntry {
  std::optional<double> value{};
  std::optional<double> upper_bound{};  ///< of use only without a value
};

/// N of both triads is required and positive. Walks: rad/s^2/sqrt(Hz) and m/s^3/sqrt(Hz).
struct ImuNoiseEntry {
  double gyro_white = 0.0;   ///< N, rad/s/sqrt(Hz)
  double accel_white = 0.0;  ///< N, m/s^2/sqrt(Hz)
  WalkEntry gyro_walk{};     ///< K, rad/s^2/sqrt(Hz)
  WalkEntry accel_walk{};    ///< K, m/s^3/sqrt(Hz)
  double rate_hz = 0.0;      ///< samples per second
  std::string topic = "/imu0";
  std::string name = "imu0";
};

/// One axis of an imu_utils file; rad/s or m/s^2, both of them.
struct ImuUtilsFigure {
  double n = 0.0;             ///< standard deviation of one sample, N sqrt(rate)
  std::optional<double> w{};  ///< minimum of the fitted Allan deviation; neither K nor the bias instability
};

/// One triad of an imu_utils file. The average is its own figure in the file and need not be the mean of the axes.
struct ImuUtilsTriad {
  std::array<ImuUtilsFigure, 3> axis{};
  ImuUtilsFigure average{};
};

/// A file to be written, or a piece of one to be pasted into a file that exists.
struct NamedText {
  std::string file_name{};           ///< of letters, digits, '_', '-' and '.' only; no folder
  std::string text{};                ///< whole content, ends with a newline
  std::string next_command{};        ///< the command of the other tool that reads it
  std::vector<std::string> notes{};  ///< what the reader of the file must know; also in it where it can hold comments
};

}  // namespace vispline
