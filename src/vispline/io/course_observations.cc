#include "vispline/io/course_observations.h"

#include <optional>

#include "vispline/io/format_words.h"

namespace vispline {
namespace {

/// Empty behind the camera and in its plane.
std::optional<Eigen::Vector2d> project(const Pose& T_c_w, const Vector3d& point_w) {
  const Vector3d point_c = T_c_w * point_w;
  if (point_c.z() <= 0.0) return std::nullopt;
  return point_c.head<2>() / point_c.z();
}

void append_point(std::string& out, const Vector3d& point_w) {
  append_number(out, point_w.x());
  append_cells(out, ' ', Eigen::Vector3d(point_w.y(), point_w.z(), 1.0));
}

}  // namespace

std::string course_point_list(const std::vector<Vector3d>& points_w) {
  std::string out;
  for (const Vector3d& point : points_w) {
    append_point(out, point);
    out += '\n';
  }
  return out;
}

std::string course_point_observations(const std::vector<Vector3d>& points_w, const Pose& T_w_c) {
  const Pose T_c_w = T_w_c.inverse();
  std::string out;
  for (const Vector3d& point : points_w) {
    const auto uv = project(T_c_w, point);
    if (!uv) continue;
    append_point(out, point);
    append_cells(out, ' ', *uv);
    out += '\n';
  }
  return out;
}

std::string course_line_observations(const std::vector<Segment>& segments_w, const Pose& T_w_c) {
  const Pose T_c_w = T_w_c.inverse();
  std::string out;
  for (const Segment& segment : segments_w) {
    const auto start = project(T_c_w, segment.start_w), end = project(T_c_w, segment.end_w);
    if (!start || !end) continue;
    append_number(out, start->x());
    append_cells(out, ' ', Eigen::Vector3d(start->y(), end->x(), end->y()));
    out += '\n';
  }
  return out;
}

}  // namespace vispline
