/// The IMU of a GoPro: an MP4 with a telemetry track, or bare GPMF payloads. docs/formats.md, Cameras.
#pragma once

#include <optional>
#include <string_view>

#include "vispline/bags/input.h"
#include "vispline/io/imu_stream.h"
#include "vispline/io/readout.h"

namespace vispline::gopro {

inline constexpr std::string_view kName = "gopro";

bool recognizes(Bytes head);

/// Gyroscope samples with the accelerometer interpolated to their stamps, in the axes X Y Z of the camera. Stamps are a
/// straight line fitted to STMP, or to the times of the MP4, over TSMP; zero is that of the camera.
ImuStreamResult stream(const Input& input, const ReadOptions& options, const ImuSink& sink,
                       const ImuStreamSettings& settings);

/// SROT: of the whole recording, or of the first payload that has one.
std::optional<Readout> readout(const Input& input);

}  // namespace vispline::gopro
