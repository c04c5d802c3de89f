/// Is it an IMU, in rad/s and m/s^2? Warnings about units and dead axes; single spikes are left out.
#pragma once

#include "vispline/io/stamps.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Flags (0: leave out) of single samples that stand far off while their neighbours agree, W-SPIKE; none if they are
/// more than 0.1 %.
std::vector<std::uint8_t> find_spikes(ReadContext& context, const ImuSignal& imu, const StampedRows& rows);

/// W-UNITS, W-CONSTANT, W-SATURATED; throws E-CONSTANT (exit 4) if every axis is constant.
void check_imu(ReadContext& context, const ImuSignal& imu);

}  // namespace vispline
