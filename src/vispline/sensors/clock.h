/// The clock of a sensor against that of the body. docs/math/camera.md, Clocks.
#pragma once

namespace vispline {

/// Sample k of a sensor that is started at t_0 is stamped t_0 + phase + k / rate, on the sensor's own clock. With s
/// since t_0 on that clock and the time offset of the sensor's calibration,
///   t_body = t_sensor + time_offset + drift s
struct ClockModel {
  double phase_s = 0.0;  ///< from the start to the first sample, not negative
  double drift = 0.0;    ///< s of the body's clock gained in a second of the sensor's
};

}  // namespace vispline
