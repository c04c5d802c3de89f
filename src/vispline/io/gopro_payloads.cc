#include "vispline/io/gopro_payloads.h"

#include <algorithm>

namespace vispline::gopro {
namespace {

/// Enough to hand on one payload, even if only its length is not to be trusted.
constexpr std::size_t kReadAhead = std::size_t{1} << 16;

}  // namespace

Payloads::Payloads(const Input& input) : input_(input), is_mp4_(mp4::recognizes(as_bytes(input.head(16)))) {
  if (is_mp4_) telemetry_ = mp4::find_telemetry(input);
}

bool Payloads::each(const Visit& visit, const ReadProgress& progress) const {
  return is_mp4_ ? each_of_track(visit, progress) : each_bare(visit, progress);
}

bool Payloads::each_of_track(const Visit& visit, const ReadProgress& progress) const {
  Window window(input_, kReadAhead);
  bool damaged = telemetry_.damaged;
  std::uint64_t taken = 0;
  for (const mp4::Payload& payload : telemetry_.payloads) {
    const bool inside = payload.offset <= input_.size() && payload.size <= input_.size() - payload.offset;
    taken += payload.size;
    if (taken > input_.size()) return true;  // payloads do not overlap
    if (!inside || payload.size > mp4::kMaxPayloadBytes) {
      damaged = true;
      continue;
    }
    for (const gpmf::Device& device : gpmf::parse(window.view(payload.offset, payload.size), damaged)) {
      if (!visit(device, payload)) return damaged;
    }
    if (progress) progress(payload.offset + payload.size, input_.size());
  }
  return damaged;
}

/// Devices one after another. Those that have an IMU take kPayloadSeconds each.
bool Payloads::each_bare(const Visit& visit, const ReadProgress& progress) const {
  constexpr std::size_t kHead = 8;
  Window window(input_, kReadAhead);
  bool damaged = false;
  mp4::Payload payload{.end_s = kPayloadSeconds};
  std::int64_t number = 0;
  while (payload.offset < input_.size()) {
    const Bytes head = window.view(payload.offset, kHead);
    const auto bytes = gpmf::bytes_of(head);
    if (!bytes) return damaged || head.size() < kHead;
    if (*bytes > input_.size() - payload.offset - kHead) return true;
    payload.size = static_cast<std::uint32_t>(kHead + *bytes);
    for (const gpmf::Device& device : gpmf::parse(window.view(payload.offset, payload.size), damaged)) {
      if (!visit(device, payload)) return damaged;
      if (!device.gyro && !device.accel) continue;
      payload.start_s = kPayloadSeconds * static_cast<double>(++number);
      payload.end_s = kPayloadSeconds * static_cast<double>(number + 1);
    }
    payload.offset += kHead + (*bytes + 3) / 4 * 4;
    if (progress) progress(std::min(payload.offset, input_.size()), input_.size());
  }
  return damaged;
}

}  // namespace vispline::gopro
