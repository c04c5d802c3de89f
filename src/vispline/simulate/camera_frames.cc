#include "vispline/simulate/camera_frames.h"

namespace vispline {

CameraFrames::CameraFrames(const std::vector<Camera>& cameras, const ClockModels& clocks, Time start, Duration duration)
    : start_(start) {
  for (const Camera& camera : cameras) {
    const ClockModel model = clock_of(clocks, camera.name);
    const Duration phase = from_seconds(model.phase_s);
    Ticks ticks{.clock = {start + phase, camera.rate_hz}, .drift = model.drift};
    if (phase < duration) ticks.count = ticks.clock.count(duration - phase);
    size_ += static_cast<std::size_t>(ticks.count);
    ticks_.push_back(ticks);
  }
}

std::optional<FrameInstant> CameraFrames::next() {
  std::optional<FrameInstant> first;
  for (std::size_t i = 0; i < ticks_.size(); ++i) {
    const Ticks& ticks = ticks_[i];
    if (ticks.next == ticks.count) continue;
    const Time stamp = ticks.clock(ticks.next);
    if (first && first->stamp <= stamp) continue;
    first = {i, static_cast<std::uint64_t>(ticks.next), stamp, ticks.drift * to_seconds(stamp - start_)};
  }
  if (first) ++ticks_[first->camera].next;
  return first;
}

}  // namespace vispline
