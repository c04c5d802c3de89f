#include "vispline/estimate/reprojection.h"

#include "vispline/core/so3.h"
#include "vispline/sensors/rolling_shutter.h"

namespace vispline {

std::optional<Vector2d> reproject(const Camera& camera, const Pose& T_w_b, const HomogeneousPoint& point) {
  const Vector3d y_b = T_w_b.R.transpose() * (point.direction_w - point.inverse_distance * T_w_b.p);
  return camera.lens.project(camera.T_c_b.R * y_b + point.inverse_distance * camera.T_c_b.p);
}

std::optional<Reprojection> linearize_reprojection(const Camera& camera, const Pose& T_w_b,
                                                   const HomogeneousPoint& point) {
  const Matrix3d& R_c_b = camera.T_c_b.R;
  const double rho = point.inverse_distance;
  const Vector3d y_b = T_w_b.R.transpose() * (point.direction_w - rho * T_w_b.p);
  const auto image = camera.lens.linearize(R_c_b * y_b + rho * camera.T_c_b.p);
  if (!image) return std::nullopt;
  const Eigen::Matrix<double, 2, 3> J_b = image->d_point * R_c_b;
  const Eigen::Matrix<double, 2, 3> J_turn = J_b * hat(y_b);
  Reprojection out;
  out.px = image->px;
  out.d_pose << -rho * J_b, J_turn;
  out.d_point.leftCols<3>() = J_b * T_w_b.R.transpose();
  out.d_point.col(3) = image->d_point * camera.T_c_b.p - out.d_point.leftCols<3>() * T_w_b.p;
  out.d_T_c_b << rho * image->d_point, -J_turn;
  out.d_lens = image->d_params;
  return out;
}

HomogeneousPoint anchored_point(const Camera& camera, const Pose& T_w_b, const InverseDepthLandmark& landmark) {
  const double rho = landmark.inverse_distance;
  const Vector3d y_b = camera.T_c_b.R.transpose() * (landmark.bearing_c - rho * camera.T_c_b.p);
  return {T_w_b.R * y_b + rho * T_w_b.p, rho};
}

AnchoredPoint linearize_anchor(const Camera& camera, const Pose& T_w_b, const InverseDepthLandmark& landmark) {
  const double rho = landmark.inverse_distance;
  const Matrix3d R_w_c = T_w_b.R * camera.T_c_b.R.transpose();
  const Vector3d y_b = camera.T_c_b.R.transpose() * (landmark.bearing_c - rho * camera.T_c_b.p);
  const Matrix3d turn = T_w_b.R * hat(y_b);
  AnchoredPoint out;
  out.point = anchored_point(camera, T_w_b, landmark);
  out.d_pose.topRows<3>() << rho * T_w_b.R, -turn;
  out.d_T_c_b.topRows<3>() << -rho * R_w_c, turn;
  out.d_bearing.topRows<3>() = R_w_c;
  out.d_inverse_distance << T_w_b.p - R_w_c * camera.T_c_b.p, 1.0;
  out.d_pose.row(3).setZero();
  out.d_T_c_b.row(3).setZero();
  out.d_bearing.row(3).setZero();
  return out;
}

std::optional<Eigen::Matrix2d> line_whitening(const Camera& camera, const Pose& T_w_b, const Vector6d& twist_b,
                                              const HomogeneousPoint& point) {
  if (camera.shutter.line_delay_s == 0.0) return Eigen::Matrix2d(Eigen::Matrix2d::Identity());
  const auto seen = linearize_reprojection(camera, T_w_b, point);
  if (!seen) return std::nullopt;
  return newton_whitening(camera.shutter, seen->d_pose * twist_b);
}

}  // namespace vispline
