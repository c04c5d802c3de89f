/// The flags that settle what a file cannot say about itself. docs/formats.md, Flags.
#pragma once

#include <string>

namespace vispline {

/// Which clock the samples of a recording of messages are put on.
enum class StampClock {
  kHeader,   ///< the stamp in the header of the message: when it was measured
  kReceive,  ///< when the recorder got the message
};

struct ReadOptions {
  std::string format = {};      ///< kName of a format; empty: found from the content
  std::string columns = {};     ///< "t,gx,gy,gz,ax,ay,az" with optional units "gx [deg/s]"; "-" skips a column
  std::string time_unit = {};   ///< s, ms, us, ns or index@RATE, RATE in Hz as 200 or 2000/7; empty: from the file
  double rate_hz = 0.0;         ///< the file has no times: its rows are samples at this rate from t = 0; 0: not given
  std::string gyro_unit = {};   ///< rad/s, deg/s, deg/h; empty: from the file
  std::string accel_unit = {};  ///< m/s^2, g, mg; empty: from the file
  std::string imu_axes = {};  ///< of a GoPro: "YxZ", the axis of each channel, small for a turned sign; empty: its own
  char decimal = '.';         ///< ',' for files with a decimal comma
  std::string topic = {};     ///< of a recording, or the sensor of an EuRoC folder; empty: the only one that fits
  std::string gyro_topic = {};  ///< the gyroscope stands alone in this topic of a recording, accel_topic goes with it
  std::string accel_topic = {};
  StampClock clock = StampClock::kHeader;
  bool skip_bad_rows = false;  ///< leave out up to 0.1 % of malformed rows instead of failing
  bool repair = false;         ///< leave out or sort more rows than the usual 1 %
  bool strict = false;         ///< the first warning is an error
};

}  // namespace vispline
