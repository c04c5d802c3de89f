#include "rig_scene.h"

#include <algorithm>
#include <filesystem>

#include "vispline/io/features.h"
#include "vispline/io/house.h"
#include "vispline/simulate/boards.h"
#include "vispline/simulate/box_room.h"
#include "vispline/simulate/random_cloud.h"

namespace vispline::cli {
Scene scene_of(const TargetCalibration& target, const Pose& T_w_t) {
  switch (target.kind) {
    case TargetKind::kAprilgrid:
      return aprilgrid_scene({target.cols, target.rows, target.tag_size_m, target.tag_spacing}, T_w_t);
    case TargetKind::kCheckerboard:
      return checkerboard_scene({target.cols, target.rows, target.col_spacing_m, target.row_spacing_m}, T_w_t);
    case TargetKind::kCirclegrid:
      return circle_grid_scene({.cols = target.cols,
                                .rows = target.rows,
                                .spacing_m = target.col_spacing_m,
                                .radius_m = 0.25 * target.col_spacing_m,
                                .is_asymmetric = target.is_asymmetric},
                               T_w_t);
  }
  return {};
}

namespace {

constexpr double kRoomMargin_m = 3.0, kCloudMargin_m = 8.0;
constexpr std::size_t kLandmarks = 3000;  // enough for the usual budget of features in a narrow view
constexpr double kBoardShare = 0.4;       // of the image

struct Box {
  Vector3d lower_w, upper_w;
};

/// Around the positions of the body, with a margin.
Box box_around(const SceneRequest& request, double margin_m) {
  constexpr int kSteps = 400;
  const TimeSpan known = request.trajectory.span();
  const Time begin = std::max(known.begin, request.span.begin), end = std::min(known.end, request.span.end);
  Box box{Vector3d::Constant(1e300), Vector3d::Constant(-1e300)};
  for (int i = 0; i <= kSteps; ++i) {
    const auto state = request.trajectory.at(begin + (end - begin) * i / kSteps);
    if (!state) continue;
    box.lower_w = box.lower_w.cwiseMin(state->p_w);
    box.upper_w = box.upper_w.cwiseMax(state->p_w);
  }
  return {box.lower_w - Vector3d::Constant(margin_m), box.upper_w + Vector3d::Constant(margin_m)};
}

Scene room_of(const SceneRequest& request) {
  const Box box = box_around(request, kRoomMargin_m);
  BoxRoom room{.lower_w = box.lower_w, .upper_w = box.upper_w, .seed = request.seed};
  room.landmarks = request.landmarks.value_or(kLandmarks);
  return box_room(room);
}

Scene cloud_of(const SceneRequest& request) {
  const Box box = box_around(request, kCloudMargin_m);
  RandomCloud cloud{.lower_w = box.lower_w, .upper_w = box.upper_w, .seed = request.seed};
  cloud.count = request.landmarks.value_or(kLandmarks);
  return random_cloud(cloud);
}

/// From the first to the last corner, m.
Vector2d size_of(const TargetCalibration& target) {
  if (target.kind == TargetKind::kAprilgrid) {
    const double gap = target.tag_size_m * target.tag_spacing;
    return Vector2d(target.cols, target.rows) * (target.tag_size_m + gap) - Vector2d::Constant(gap);
  }
  const Vector2d steps((target.is_asymmetric ? 2.0 : 1.0) * target.cols - 1.0, target.rows - 1.0);
  return steps.cwiseProduct(Vector2d(target.col_spacing_m, target.row_spacing_m)).cwiseMax(target.col_spacing_m);
}

/// In the middle of the first camera's view at the start, upright and facing it.
Pose board_pose(const SceneRequest& request, const Vector2d& size_m) {
  require(!request.rig.cameras.empty(), "a rig with a camera for a scene with a board");
  const Camera& camera = request.rig.cameras[0];
  const auto state = request.trajectory.at(std::max(request.trajectory.span().begin, request.span.begin));
  require(state.has_value(), "a start inside the trajectory");
  const Pose T_w_c = state->T_w_b() * camera.T_c_b.inverse();
  const Vector2d side_px(camera.resolution_px[0], camera.resolution_px[1]);
  const Vector2d middle_px = 0.5 * side_px;
  const auto axis_c = camera.lens.unproject(middle_px);
  const auto edge_c = camera.lens.unproject(middle_px + Vector2d(0.5 * kBoardShare * side_px.minCoeff(), 0.0));
  require(axis_c.has_value() && edge_c.has_value(), "a lens that sees the middle of its image");
  const double angle = std::acos(std::clamp(axis_c->dot(*edge_c), -1.0, 1.0));
  const double distance_m = 0.5 * size_m.maxCoeff() / std::tan(angle);
  Pose T_c_t;
  T_c_t.R = Vector3d(1.0, -1.0, -1.0).asDiagonal();
  T_c_t.p = distance_m * *axis_c - T_c_t.R * Vector3d(0.5 * size_m.x(), 0.5 * size_m.y(), 0.0);
  return T_w_c * T_c_t;
}

std::optional<TargetCalibration> named_target(const std::string& name) {
  if (name == "aprilgrid") {
    return TargetCalibration{
        .kind = TargetKind::kAprilgrid, .cols = 6, .rows = 6, .tag_size_m = 0.088, .tag_spacing = 0.3};
  }
  const bool is_circles = name == "circles";
  if (name != "checkerboard" && !is_circles) return std::nullopt;
  return TargetCalibration{.kind = is_circles ? TargetKind::kCirclegrid : TargetKind::kCheckerboard,
                           .cols = is_circles ? 7 : 9,
                           .rows = 6,
                           .col_spacing_m = 0.04,
                           .row_spacing_m = 0.04};
}

std::optional<TargetCalibration> target_in_file(const std::string& path, Session& session) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension != ".yaml" && extension != ".yml" && extension != ".json") return std::nullopt;
  TargetReading reading = read_target_file(path);
  session.add(reading.diagnostics);
  return reading.target;
}

Scene points_in_file(const std::string& path, Session& session) {
  auto points = read_points(path);
  session.add_input("scene", points.counts, points.diagnostics);
  Scene scene;
  for (const auto& [id, point_w] : points.value) scene.landmarks.push_back({.id = id, .point_w = point_w});
  return scene;
}

}  // namespace

SceneSource load_scene(const SceneRequest& request, Session& session) {
  const std::string& name = request.name;
  if (name == "house") return {.scene = point_scene(house_points())};
  if (name == "room") return {.scene = room_of(request)};
  if (name == "cloud") return {.scene = cloud_of(request)};
  std::optional<TargetCalibration> target = named_target(name);
  if (!target) target = target_in_file(name, session);
  if (!target) return {.scene = points_in_file(name, session)};
  const Pose T_w_t = board_pose(request, size_of(*target));
  return {.scene = scene_of(*target, T_w_t), .target = target, .T_w_t = T_w_t};
}

}  // namespace vispline::cli
