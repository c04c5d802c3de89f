#include "vispline/calibration/rig_checks.h"

#include <Eigen/SVD>
#include <cmath>

#include "vispline/calibration/dialect_text.h"

namespace vispline {
namespace {

struct ParameterCount {
  std::string_view model;
  std::size_t count;
};

constexpr ParameterCount kModels[] = {{"pinhole", 4}, {"omni", 5}, {"ds", 6}, {"eucm", 6}};
constexpr ParameterCount kDistortions[] = {{"radtan", 4}, {"equidistant", 4}, {"fov", 1}, {"none", 0}};
constexpr int kLargestSide = 65535;
constexpr double kKept = 1e-6, kProjected = 1e-3;

template <std::size_t kSize>
std::string problem_of_list(const ParameterCount (&known)[kSize], const std::string& model,
                            const std::vector<double>& values, const std::string& what) {
  std::string names;
  for (const ParameterCount& row : known) {
    if (row.model == model) {
      if (values.size() == row.count) return "";
      return std::to_string(values.size()) + " " + what + " parameters, " + model + " has " + std::to_string(row.count);
    }
    names += (names.empty() ? "" : ", ") + std::string(row.model);
  }
  return "unknown " + what + " model " + vispline::quoted(model) + ", expected one of: " + names;
}

std::string problem_of_numbers(const CameraCalibration& camera) {
  for (const auto* list : {&camera.intrinsics, &camera.distortion}) {
    for (const double value : *list) {
      if (!std::isfinite(value)) return "a parameter that is not finite";
    }
  }
  const auto projection = projection_of(camera);
  for (const std::size_t i : {0, 1}) {
    if (projection[i] > 0.0) continue;
    return std::string("f") + "uv"[i] + " is " + dialect::brief(projection[i]) + ", expected a positive number of px";
  }
  return "";
}

}  // namespace

bool is_ideal(const ImuCalibration& imu) {
  return imu.gyro_M == Matrix3d::Identity() && imu.R_gyro_imu == Matrix3d::Identity() &&
         imu.gyro_A == Matrix3d::Zero() && imu.accel_M == Matrix3d::Identity() &&
         imu.R_accel_imu == Matrix3d::Identity();
}

std::optional<Pose> imu_to_camera(const RigCalibration& rig, std::size_t index) {
  const CameraCalibration& camera = rig.cameras[index];
  if (camera.T_cam_imu) return camera.T_cam_imu;
  if (index == 0 || !camera.T_cn_cnm1) return std::nullopt;
  const auto before = imu_to_camera(rig, index - 1);
  return before ? std::optional(*camera.T_cn_cnm1 * *before) : std::nullopt;
}

std::array<double, 4> projection_of(const CameraCalibration& camera) {
  const double* first = camera.intrinsics.data() + camera.intrinsics.size() - 4;
  return {first[0], first[1], first[2], first[3]};
}

namespace rig_checks {

std::string problem_of(const CameraCalibration& camera) {
  std::string problem = problem_of_list(kModels, camera.model, camera.intrinsics, "camera");
  if (problem.empty())
    problem = problem_of_list(kDistortions, camera.distortion_model, camera.distortion, "distortion");
  if (problem.empty()) problem = problem_of_numbers(camera);
  for (const int side : camera.resolution_px) {
    if (!problem.empty() || (side >= 1 && side <= kLargestSide)) continue;
    problem = "a resolution of " + std::to_string(side) + " px, expected 1 to " + std::to_string(kLargestSide);
  }
  return problem;
}

void require_possible(const ConfigMap& map, std::string_view key, const CameraCalibration& camera) {
  const std::string problem = problem_of(camera);
  if (!problem.empty()) map.fail(key, "cannot be: " + problem);
}

Matrix3d checked_rotation(ConfigMap& map, std::string_view key, const Matrix3d& R) {
  const double error = (R.transpose() * R - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kProjected)) map.fail(key, "is not a rotation: R^T R is off by " + dialect::brief(error));
  if (R.determinant() < 0.0) map.fail(key, "is a reflection: its determinant is -1");
  if (error <= kKept) return R;
  map.warn(key, "is not quite a rotation, R^T R is off by " + dialect::brief(error) + ": the nearest one is used");
  const Eigen::JacobiSVD<Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Pose read_pose(ConfigMap& map, std::string_view key) {
  const std::vector<double> cells = map.matrix(key, 4, 4, "m");
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(cells.data());
  if ((T.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > kKept) {
    map.fail(key, "has a last row that is not 0 0 0 1");
  }
  const Matrix3d R = T.topLeftCorner<3, 3>();
  return {checked_rotation(map, key, R), T.topRightCorner<3, 1>()};
}

Matrix3d read_matrix3(ConfigMap& map, std::string_view key, std::string_view unit) {
  const std::vector<double> cells = map.matrix(key, 3, 3, unit);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(cells.data());
}

}  // namespace rig_checks
}  // namespace vispline
