/// One image of a camera that moves along a trajectory: where it sees a landmark, line by line.
#pragma once

#include <optional>

#include "vispline/simulate/body_instant.h"
#include "vispline/simulate/camera_frames.h"
#include "vispline/simulate/scene.h"

namespace vispline {

struct ShutterSight {
  std::optional<Vector2d> px;  ///< empty: not in sight
  bool is_unsolved = false;    ///< it may be in sight, but its line could not be told
};

class ShutterView {
 public:
  /// All must outlive this.
  ShutterView(const Trajectory& trajectory, const Camera& camera, const FrameInstant& instant);

  /// Whether the trajectory is known while any line is exposed.
  bool is_covered() const;
  /// The pixel at which the landmark is when the line of that pixel is exposed, if it is in the image and nothing hides
  /// it then. Precondition: is_covered().
  ShutterSight see(const Scene& scene, const SceneLandmark& landmark) const;

 private:
  /// State of the body when the line of a pixel with that delay (Camera::delay_s) is exposed.
  std::optional<BodyState> body_at(double delay_s) const;

  const Trajectory& trajectory_;
  const Camera& camera_;
  const FrameInstant& instant_;
};

}  // namespace vispline
