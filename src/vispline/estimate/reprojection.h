/// The kernel of every visual row: where a point is seen, and how that moves. docs/math/estimate.md, Visual rows;
/// Lovegrove et al. 2013, equations (7) and (10), with the columns the paper leaves to automatic differentiation.
#pragma once

#include <optional>

#include "vispline/sensors/camera.h"
#include "vispline/sensors/landmark.h"

namespace vispline {

using Matrix2x6 = Eigen::Matrix<double, 2, 6>;

/// px; derivatives with respect to the pose of the body (right perturbation: position, rotation), the homogeneous point
/// (direction_w, inverse_distance), T_c_b (translation by addition, rotation on the right) and the lens.
struct Reprojection {
  Vector2d px;
  Matrix2x6 d_pose;
  Eigen::Matrix<double, 2, 4> d_point;
  Matrix2x6 d_T_c_b;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMaxLensParams> d_lens;
};

/// px alone; empty where the lens has no image of the point.
std::optional<Vector2d> reproject(const Camera& camera, const Pose& T_w_b, const HomogeneousPoint& point);
std::optional<Reprojection> linearize_reprojection(const Camera& camera, const Pose& T_w_b,
                                                   const HomogeneousPoint& point);

/// A point of a reference view in the world, and how it moves: rows direction_w (3) and inverse_distance (1).
struct AnchoredPoint {
  HomogeneousPoint point;
  Eigen::Matrix<double, 4, 6> d_pose;     ///< of the body at the reference instant
  Eigen::Matrix<double, 4, 6> d_T_c_b;    ///< of the reference camera
  Eigen::Matrix<double, 4, 3> d_bearing;  ///< of bearing_c, all three coordinates
  Eigen::Vector4d d_inverse_distance;
};
HomogeneousPoint anchored_point(const Camera& camera, const Pose& T_w_b, const InverseDepthLandmark& landmark);
AnchoredPoint linearize_anchor(const Camera& camera, const Pose& T_w_b, const InverseDepthLandmark& landmark);

/// What turns (predicted at the measured line - measured) into the residual of the pixel itself: newton_whitening() for
/// a point seen from the body at T_w_b that moves with twist_b. Empty also where the lens has no image.
std::optional<Eigen::Matrix2d> line_whitening(const Camera& camera, const Pose& T_w_b, const Vector6d& twist_b,
                                              const HomogeneousPoint& point);

}  // namespace vispline
