#include "vispline/results/alignment.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr std::array<std::pair<AlignmentMode, std::string_view>, 4> kNames{{{AlignmentMode::kNone, "none"},
                                                                            {AlignmentMode::kSe3, "se3"},
                                                                            {AlignmentMode::kSim3, "sim3"},
                                                                            {AlignmentMode::kYaw, "yaw"}}};
/// Points count as one line where their width across it is below this share of their length.
constexpr double kMinWidth = 1e-6;
/// ... and as one point where their extent is below this share of their distance from the origin.
constexpr double kMinExtent = 1e-12;

using Points = Eigen::Matrix3Xd;

struct Centred {
  Vector3d mean;
  Points points;
};

Centred centred(const std::vector<Vector3d>& points) {
  Points all(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = points[i];
  const Vector3d mean = all.rowwise().mean();
  return {mean, all.colwise() - mean};
}

[[noreturn]] void fail(AlignmentMode mode, const std::string& reason) {
  throw Error(ExitCode::kUnfit, {.code = "E-ALIGN",
                                 .message = "alignment " + std::string(to_name(mode)) + " is not unique: " + reason,
                                 .where = "",
                                 .effect = "nothing compared",
                                 .next = "compare with alignment 'none', or over a longer, less straight path"});
}

/// Root mean square extents of the points along their principal axes, longest first, in metres.
Vector3d extents(const Points& points) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(points * points.transpose(), Eigen::EigenvaluesOnly);
  return (eigen.eigenvalues().reverse().cwiseMax(0.0) / static_cast<double>(points.cols())).cwiseSqrt();
}

void require_spread(AlignmentMode mode, const Centred& c, const char* which) {
  const bool yaw = mode == AlignmentMode::kYaw;
  Points points = c.points;
  if (yaw) points.row(2).setZero();
  const Vector3d extent = extents(points);
  if (extent(0) <= kMinExtent * (1.0 + c.mean.norm())) {
    fail(mode, std::string("all points of the ") + which + (yaw ? " are on one vertical line" : " coincide"));
  }
  if (!yaw && extent(1) <= kMinWidth * extent(0))
    fail(mode, std::string("all points of the ") + which + " are collinear");
}

Matrix3d yaw_rotation(const Matrix3d& C_r_e) {
  const double yaw = std::atan2(C_r_e(1, 0) - C_r_e(0, 1), C_r_e(0, 0) + C_r_e(1, 1));
  return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
}

Matrix3d umeyama_rotation(const Matrix3d& C_r_e) {
  const Eigen::JacobiSVD<Matrix3d> svd(C_r_e, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

std::string_view to_name(AlignmentMode mode) {
  for (const auto& [value, name] : kNames) {
    if (value == mode) return name;
  }
  return "";
}

std::optional<AlignmentMode> alignment_from_name(std::string_view name) {
  for (const auto& [value, known] : kNames) {
    if (known == name) return value;
  }
  return std::nullopt;
}

Alignment align(AlignmentMode mode, const std::vector<Vector3d>& points_e, const std::vector<Vector3d>& points_r) {
  require(points_e.size() == points_r.size(), "as many points of the estimate as of the reference");
  Alignment alignment;
  if (mode == AlignmentMode::kNone) return alignment;
  if (points_e.size() < 3) fail(mode, std::to_string(points_e.size()) + " points, at least 3 are needed");
  const Centred e = centred(points_e), r = centred(points_r);
  require_spread(mode, e, "estimate");
  require_spread(mode, r, "reference");
  const Matrix3d C_r_e = r.points * e.points.transpose();
  alignment.R_r_e = mode == AlignmentMode::kYaw ? yaw_rotation(C_r_e) : umeyama_rotation(C_r_e);
  if (mode == AlignmentMode::kSim3) {
    alignment.scale = (alignment.R_r_e.transpose() * C_r_e).trace() / e.points.squaredNorm();
  }
  alignment.p_r_e = r.mean - alignment.scale * (alignment.R_r_e * e.mean);
  return alignment;
}

}  // namespace vispline
