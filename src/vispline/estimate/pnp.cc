#include "vispline/estimate/pnp.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "vispline/core/se3.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

constexpr double kFlat = 1e-3;     // smallest extent of the points over their largest, below which they are a plane
constexpr double kHuber_px = 2.0;  // residuals beyond it are weighed down
constexpr double kInlier_px = 6.0;
constexpr int kRefinements = 15;

struct Rays {
  std::vector<Vector3d> bearing_c, point_t;
};

/// Origin and axes of the points; the last axis is the one of least extent.
struct Frame {
  Pose T_t_f{};
  bool flat = false;

  explicit Frame(const std::vector<Vector3d>& points) {
    for (const Vector3d& p : points) T_t_f.p += p / static_cast<double>(points.size());
    Matrix3d scatter = Matrix3d::Zero();
    for (const Vector3d& p : points) scatter += (p - T_t_f.p) * (p - T_t_f.p).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(scatter);
    T_t_f.R.col(0) = axes.eigenvectors().col(2);
    T_t_f.R.col(1) = axes.eigenvectors().col(1);
    T_t_f.R.col(2) = T_t_f.R.col(0).cross(T_t_f.R.col(1));
    flat = axes.eigenvalues()(0) < kFlat * kFlat * axes.eigenvalues()(2);
  }
};

/// b x (P X) = 0 for all rays, X homogeneous: the matrix P of least residual, in front of the camera.
template <int kCoordinates>
Eigen::Matrix<double, 3, kCoordinates> direct_linear(const Rays& rays, const Pose& T_f_t) {
  constexpr int kSize = 3 * kCoordinates;
  Eigen::Matrix<double, kSize, kSize> normal = Eigen::Matrix<double, kSize, kSize>::Zero();
  const auto homogeneous = [&](std::size_t i) {
    const Vector3d p = T_f_t * rays.point_t[i];
    Eigen::Matrix<double, kCoordinates, 1> X;
    X.template head<kCoordinates - 1>() = p.head<kCoordinates - 1>();
    X(kCoordinates - 1) = 1.0;
    return X;
  };
  for (std::size_t i = 0; i < rays.point_t.size(); ++i) {
    const auto X = homogeneous(i);
    Eigen::Matrix<double, 3, kSize> A;
    const Matrix3d cross = hat(rays.bearing_c[i]);
    for (int k = 0; k < kCoordinates; ++k) A.template middleCols<3>(3 * k) = X(k) * cross;
    normal += A.transpose() * A;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normal);
  const Eigen::Matrix<double, kSize, 1> least = eigen.eigenvectors().col(0);
  Eigen::Matrix<double, 3, kCoordinates> P = least.template reshaped<Eigen::ColMajor>(3, kCoordinates);
  double front = 0.0;
  for (std::size_t i = 0; i < rays.point_t.size(); ++i) front += rays.bearing_c[i].dot(P * homogeneous(i));
  return front < 0.0 ? Eigen::Matrix<double, 3, kCoordinates>(-P) : P;
}

/// M (M^T M)^-1/2; for a mirrored M the axis of least extent is turned round.
Matrix3d nearest_rotation(const Matrix3d& M) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> square(M.transpose() * M);
  Vector3d inverse = square.eigenvalues().cwiseSqrt().cwiseInverse();
  if (M.determinant() < 0.0) inverse(0) = -inverse(0);
  return M * square.eigenvectors() * inverse.asDiagonal() * square.eigenvectors().transpose();
}

/// T_c_t without noise model.
std::optional<Pose> linear_pose(const Rays& rays) {
  const Frame frame(rays.point_t);
  const Pose T_f_t = frame.T_t_f.inverse();
  Pose T_c_f;
  if (frame.flat) {
    const Matrix3d H = direct_linear<3>(rays, T_f_t);
    const double scale = 2.0 / (H.col(0).norm() + H.col(1).norm());
    Matrix3d M;
    M << scale * H.col(0), scale * H.col(1), scale * scale * H.col(0).cross(H.col(1));
    T_c_f = {nearest_rotation(M), scale * H.col(2)};
  } else {
    if (rays.point_t.size() < 6) return std::nullopt;
    const Eigen::Matrix<double, 3, 4> P = direct_linear<4>(rays, T_f_t);
    const double volume = P.leftCols<3>().determinant();
    if (volume <= 0.0) return std::nullopt;
    const double scale = 1.0 / std::cbrt(volume);
    T_c_f = {nearest_rotation(scale * P.leftCols<3>()), scale * P.col(3)};
  }
  if (!T_c_f.p.allFinite() || !T_c_f.R.allFinite()) return std::nullopt;
  return T_c_f * T_f_t;
}

/// One Gauss-Newton step of T_c_t exp(delta); the root of the mean squared residual of the inliers comes back.
double refine(const Camera& camera, const std::vector<Vector2d>& px, const std::vector<Vector3d>& point_t, Pose& T_c_t,
              int& inliers) {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  double sum = 0.0;
  inliers = 0;
  for (std::size_t i = 0; i < px.size(); ++i) {
    const auto seen = camera.lens.linearize(T_c_t * point_t[i]);
    if (!seen) continue;
    const Vector2d r = seen->px - px[i];
    const double size = r.norm();
    if (size < kInlier_px) {
      ++inliers;
      sum += r.squaredNorm();
    }
    Eigen::Matrix<double, 2, 6> J;
    J << seen->d_point * T_c_t.R, -seen->d_point * T_c_t.R * hat(point_t[i]);
    const double weight = size > kHuber_px ? kHuber_px / size : 1.0;
    H += weight * J.transpose() * J;
    g += weight * J.transpose() * r;
  }
  const Vector6d delta = -H.llt().solve(g);
  if (delta.allFinite()) T_c_t = T_c_t * SE3::exp<double>(delta);
  return inliers > 0 ? std::sqrt(sum / (2.0 * inliers)) : 0.0;
}

/// A plane seen from far looks nearly the same when it leans the other way: its normal mirrored at the line of sight.
Pose mirrored(const Pose& T_c_t, const Frame& frame) {
  const Vector3d centre_c = T_c_t * frame.T_t_f.p, sight_c = centre_c.normalized();
  const Vector3d normal_c = T_c_t.R * frame.T_t_f.R.col(2);
  const Vector3d turn = 2.0 * std::asin(std::min(1.0, normal_c.cross(sight_c).norm())) *
                        normal_c.cross(sight_c).normalized() * (normal_c.dot(sight_c) < 0.0 ? -1.0 : 1.0);
  const Matrix3d R = SO3::exp<double>(turn);
  return {R * T_c_t.R, centre_c - R * T_c_t.R * frame.T_t_f.p};
}

PnpResult refined(const Camera& camera, const std::vector<Vector2d>& px, const std::vector<Vector3d>& point_t,
                  Pose T_c_t) {
  PnpResult result;
  for (int i = 0; i < kRefinements; ++i) result.rms_px = refine(camera, px, point_t, T_c_t, result.inliers);
  result.T_t_c = T_c_t.inverse();
  return result;
}

bool is_better(const PnpResult& a, const PnpResult& b) {
  return a.inliers != b.inliers ? a.inliers > b.inliers : a.rms_px < b.rms_px;
}

}  // namespace

std::optional<PnpResult> camera_pose(const Camera& camera, const std::vector<Vector2d>& px,
                                     const std::vector<Vector3d>& point_t) {
  Rays rays;
  for (std::size_t i = 0; i < px.size(); ++i) {
    const auto bearing_c = camera.lens.unproject(px[i]);
    if (!bearing_c) continue;
    rays.bearing_c.push_back(*bearing_c);
    rays.point_t.push_back(point_t[i]);
  }
  if (rays.point_t.size() < 4) return std::nullopt;
  const auto T_c_t = linear_pose(rays);
  if (!T_c_t) return std::nullopt;
  PnpResult result = refined(camera, px, point_t, *T_c_t);
  const Frame frame(rays.point_t);
  if (frame.flat && result.T_t_c.p.allFinite()) {
    const PnpResult other = refined(camera, px, point_t, mirrored(result.T_t_c.inverse(), frame));
    if (other.T_t_c.p.allFinite() && is_better(other, result)) result = other;
  }
  if (2 * static_cast<std::size_t>(result.inliers) < px.size() || !result.T_t_c.p.allFinite()) return std::nullopt;
  return result;
}

}  // namespace vispline
