/// When the cameras of a rig take their images.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vispline/core/time.h"
#include "vispline/sensors/camera.h"
#include "vispline/sensors/clock.h"

namespace vispline {

/// One image of one camera.
struct FrameInstant {
  std::size_t camera = 0;  ///< place in the rig
  std::uint64_t index = 0;
  Time stamp{};                ///< on the clock of the camera
  double clock_delay_s = 0.0;  ///< what the drift has made: t_body = stamp + clock_delay + time_offset
};

/// All images stamped in [start, start + duration), by their stamps, then by camera; each camera's start at its phase.
class CameraFrames {
 public:
  /// Throws as clock_of().
  CameraFrames(const std::vector<Camera>& cameras, const ClockModels& clocks, Time start, Duration duration);
  /// Empty after the last one.
  std::optional<FrameInstant> next();
  std::size_t size() const { return size_; }

 private:
  struct Ticks {
    SampleClock clock{};
    double drift = 0.0;
    std::int64_t next = 0;
    std::int64_t count = 0;
  };

  Time start_;
  std::vector<Ticks> ticks_;  ///< by camera
  std::size_t size_ = 0;
};

}  // namespace vispline
