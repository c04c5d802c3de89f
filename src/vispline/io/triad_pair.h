/// A gyroscope and an accelerometer that were recorded apart, as one IMU.
#pragma once

#include <vector>

#include "vispline/core/types.h"
#include "vispline/io/imu_screen.h"

namespace vispline {

/// Hands each gyroscope sample on with the accelerometer interpolated linearly to its stamp. Gyroscope samples outside
/// the span of the accelerometer are dropped (W-UNPAIRED). Counts every gyroscope sample as read. Stamps of `accel`
/// must not decrease. Either may be empty: the other is handed on alone.
void push_paired(ReadContext& context, const std::vector<SensorRow>& gyro, const std::vector<SensorRow>& accel,
                 ImuScreen& screen);

/// E-COLUMNS unless the recording has all six axes where `whole` asks for them.
void require_imu(const ReadContext& context, const ImuAxes& axes, bool whole);

/// Triads that were recorded apart are held whole: two days of both at 200 Hz. E-LIMIT (exit 7) above 64 million.
void require_below(const ReadContext& context, std::size_t held, const std::string& what);

}  // namespace vispline
