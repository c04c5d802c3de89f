/// What the cameras of a simulated rig look at: by name, or from a file of points or of a target.
#pragma once

#include <optional>
#include <string>

#include "console.h"
#include "vispline/calibration/target_file.h"
#include "vispline/sensors/rig.h"
#include "vispline/simulate/scene.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline::cli {

inline constexpr const char* kSceneHelp =
    "house, room, cloud, aprilgrid, checkerboard, circles, a target.yaml, or a file of points id,x,y,z";

struct SceneSource {
  Scene scene{};
  std::optional<TargetCalibration> target{};  ///< the scene is a board of this kind
  Pose T_w_t{};                               ///< of the board
};

struct SceneRequest {
  std::string name{};
  const Trajectory& trajectory;
  const Rig& rig;
  TimeSpan span{};                         ///< of the simulation
  std::optional<std::size_t> landmarks{};  ///< of a room or a cloud
  std::uint64_t seed = 0;
};

/// The board alone; the ids of its landmarks are those of its corners.
Scene scene_of(const TargetCalibration& target, const Pose& T_w_t);

/// A room and a cloud reach around the whole motion; a board stands in front of the first camera as it is at the start.
/// Throws what the readers throw, E-ARGUMENT for a board without a camera.
SceneSource load_scene(const SceneRequest& request, Session& session);

}  // namespace vispline::cli
