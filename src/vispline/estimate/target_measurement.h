/// Points of a known target in one image. docs/math/estimate.md, Visual rows.
#pragma once

#include <memory>
#include <vector>

#include "vispline/estimate/measurement.h"

namespace vispline {

struct TargetFrame {
  std::size_t camera = 0;         ///< of the rig
  Time stamp{};                   ///< of the frame, on the camera's clock
  std::vector<Vector2d> px{};     ///< measured
  std::vector<Vector3d> point{};  ///< frame w, m: the target is the world
  double sigma_px = 1.0;
  Huber loss{};
};

std::unique_ptr<Measurement> target_measurement(const State& state, TargetFrame frame);

}  // namespace vispline
