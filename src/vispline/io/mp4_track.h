/// Where the telemetry of a GoPro stands in an MP4: the samples of its `gpmd` track, found by walking the boxes.
/// ISO/IEC 14496-12; no picture is decoded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vispline/bags/input.h"

namespace vispline::mp4 {

/// Bytes and time of one payload of the track.
struct Payload {
  std::uint64_t offset = 0;
  std::uint32_t size = 0;
  double start_s = 0.0, end_s = 0.0;
};

struct Telemetry {
  std::vector<Payload> payloads{};  ///< of the first gpmd track, in the order of the file; empty: there is none
  std::string settings{};           ///< the GPMF box of the user data: what holds for the whole recording
  bool damaged = false;             ///< a box or a table that leaves its place was passed over
};

inline constexpr std::uint32_t kMaxPayloadBytes = std::uint32_t{16} << 20;

/// Throws E-LIMIT (exit 7) above 100 000 boxes or for a table of more than 8 MiB.
Telemetry find_telemetry(const Input& input);

/// A file of this kind starts with an `ftyp` box.
bool recognizes(Bytes head);

}  // namespace vispline::mp4
