/// acc_n gyr_n acc_w gyr_w of VINS-Fusion and VINS-Mono: per sample, not densities. Its preintegration adds
/// (acc_n dt)^2 to the variance of the velocity and (acc_w dt)^2 to that of the bias in each step, where densities
/// would add N^2 dt and K^2 dt; so acc_n = N sqrt(rate) and acc_w = K sqrt(rate).
#pragma once

#include "vispline/calibration/noise_reading.h"

namespace vispline::vins_fusion_noise {

inline constexpr const char* kName = "vins-fusion";

NamedText write(const ImuNoiseEntry& entry);

/// By content.
bool recognizes(const YamlFile& file);
/// Needs options.rate_hz. The other keys of the configuration are left alone.
NoiseReading read(const YamlFile& file, const NoiseReadOptions& options);

}  // namespace vispline::vins_fusion_noise
