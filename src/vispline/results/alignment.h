/// Closed-form alignment of an estimated trajectory with its reference: S. Umeyama, "Least-squares estimation of
/// transformation parameters between two point patterns", TPAMI 13(4), 1991. docs/math/evaluate.md (4)-(8).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/core/types.h"

namespace vispline {

enum class AlignmentMode {
  kNone,  ///< the two world frames are the same
  kSe3,   ///< rotation and translation
  kSim3,  ///< rotation, translation and scale
  kYaw,   ///< rotation about the vertical z axis and translation: what a visual-inertial estimate leaves free
};

/// "none", "se3", "sim3" or "yaw".
std::string_view to_name(AlignmentMode mode);
/// Inverse of to_name; empty for any other text.
std::optional<AlignmentMode> alignment_from_name(std::string_view name);

/// p_r = scale R_r_e p_e + p_r_e: from the world of the estimate (e) to that of the reference (r).
struct Alignment {
  Matrix3d R_r_e = Matrix3d::Identity();
  Vector3d p_r_e = Vector3d::Zero();  ///< m, in frame r
  double scale = 1.0;                 ///< m of the reference per m of the estimate; 1 unless kSim3

  Vector3d operator*(const Vector3d& p_e) const { return scale * (R_r_e * p_e) + p_r_e; }
  Pose operator*(const Pose& T_e_b) const { return {R_r_e * T_e_b.R, *this * T_e_b.p}; }
};

/// The alignment with the least sum of |p_r - scale R_r_e p_e - p_r_e|^2 over corresponding points.
/// Throws Error(kUnfit, "E-ALIGN") where it is not unique: fewer than three points, or all of them on one line (kSe3,
/// kSim3) or on one vertical line (kYaw).
Alignment align(AlignmentMode mode, const std::vector<Vector3d>& points_e, const std::vector<Vector3d>& points_r);

}  // namespace vispline
