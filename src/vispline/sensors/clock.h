/// The clock of a sensor against that of the body. docs/math/features.md, Clocks.
#pragma once

#include <map>
#include <string>

namespace vispline {

/// Sample k of a sensor that is started at t_0 is stamped t_0 + phase + k / rate, on the sensor's own clock. With s
/// since t_0 on that clock and the time offset of the sensor's calibration,
///   t_body = t_sensor + time_offset + drift s
struct ClockModel {
  double phase_s = 0.0;  ///< from the start to the first sample, not negative
  double drift = 0.0;    ///< s of the body's clock gained in a second of the sensor's
};

using ClockModels = std::map<std::string, ClockModel>;  ///< by the name of the sensor; absent: no phase, no drift

/// The clock of a sensor. Throws E-ARGUMENT for a phase that is negative or not finite, and a drift of 1 % or more.
ClockModel clock_of(const ClockModels& clocks, const std::string& sensor);

}  // namespace vispline
