/// Points in the world as an estimator holds them: at an inverse distance along the ray of a reference view, or known.
/// docs/math/camera.md, Landmarks; Lovegrove et al. 2013, equation (7).
#pragma once

#include "vispline/core/pose.h"

namespace vispline {

/// A point in w in homogeneous form, direction_w / inverse_distance: at infinity nothing is singular.
struct HomogeneousPoint {
  Vector3d direction_w = Vector3d::UnitZ();  ///< m times inverse_distance
  double inverse_distance = 0.0;             ///< 1/m; 0: a point at infinity

  static HomogeneousPoint known(const Vector3d& point_w) { return {point_w, 1.0}; }
  /// Seen from camera pose T_w_c as a direction in frame c (not normalised): what Lens::project takes.
  Vector3d seen_from(const Pose& T_w_c) const {
    return T_w_c.R.transpose() * (direction_w - inverse_distance * T_w_c.p);
  }
};

/// Anchored at its reference view: the point is bearing_c / inverse_distance in the camera at that instant.
struct InverseDepthLandmark {
  Vector3d bearing_c = Vector3d::UnitZ();  ///< unit vector
  double inverse_distance = 0.0;           ///< 1/m, along the ray

  HomogeneousPoint in_world(const Pose& T_w_c) const {
    return {T_w_c.R * bearing_c + inverse_distance * T_w_c.p, inverse_distance};
  }
};

}  // namespace vispline
