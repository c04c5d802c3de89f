#include "vispline/results/alignment.h"

#include <gtest/gtest.h>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

Vector3d random_vector(const RandomStream& random, std::uint64_t index) {
  return {random.normal(3 * index), random.normal(3 * index + 1), random.normal(3 * index + 2)};
}

std::vector<Vector3d> random_points(std::uint64_t seed, std::size_t n, double sigma_m) {
  const RandomStream random(seed, "points");
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(Vector3d(20.0, -7.0, 3.0) + sigma_m * random_vector(random, i));
  return points;
}

std::vector<Vector3d> moved(const Alignment& alignment, const std::vector<Vector3d>& points) {
  std::vector<Vector3d> result;
  for (const Vector3d& point : points) result.push_back(alignment * point);
  return result;
}

double cost(const Alignment& alignment, const std::vector<Vector3d>& points_e, const std::vector<Vector3d>& points_r) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points_e.size(); ++i) sum += (points_r[i] - alignment * points_e[i]).squaredNorm();
  return sum;
}

Alignment random_alignment(std::uint64_t seed, double scale) {
  const RandomStream random(seed, "alignment");
  return {SO3::exp<double>(1.5 * random_vector(random, 0)), 30.0 * random_vector(random, 1), scale};
}

std::string error_code(AlignmentMode mode, const std::vector<Vector3d>& points_e,
                       const std::vector<Vector3d>& points_r) {
  try {
    align(mode, points_e, points_r);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUnfit);
    return error.diagnostic().code;
  }
  return "";
}

TEST(Alignment, NamesReadBack) {
  for (const AlignmentMode mode :
       {AlignmentMode::kNone, AlignmentMode::kSe3, AlignmentMode::kSim3, AlignmentMode::kYaw}) {
    EXPECT_EQ(alignment_from_name(to_name(mode)), mode);
  }
  EXPECT_FALSE(alignment_from_name("Se3"));
}

TEST(Alignment, RecoversRandomSimilarities) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Alignment truth = random_alignment(seed, 0.2 + 0.1 * static_cast<double>(seed));
    const std::vector<Vector3d> points = random_points(seed, 3 + seed % 20, 5.0);
    const Alignment found = align(AlignmentMode::kSim3, points, moved(truth, points));
    EXPECT_LT((found.R_r_e - truth.R_r_e).norm(), 1e-11) << seed;
    EXPECT_LT((found.p_r_e - truth.p_r_e).norm(), 1e-9) << seed;
    EXPECT_NEAR(found.scale, truth.scale, 1e-11 * truth.scale) << seed;
  }
}

TEST(Alignment, RigidKeepsScaleOne) {
  const Alignment truth = random_alignment(3, 1.0);
  const std::vector<Vector3d> points = random_points(3, 40, 5.0);
  const Alignment rigid = align(AlignmentMode::kSe3, points, moved(truth, points));
  EXPECT_EQ(rigid.scale, 1.0);
  EXPECT_LT((rigid.R_r_e - truth.R_r_e).norm(), 1e-12);
  EXPECT_EQ(align(AlignmentMode::kNone, {}, {}).R_r_e, Matrix3d::Identity());
}

TEST(Alignment, NeverReflects) {
  std::vector<Vector3d> points = random_points(4, 30, 5.0), mirrored = points;
  for (Vector3d& point : mirrored) point.x() = -point.x();
  for (const AlignmentMode mode : {AlignmentMode::kSe3, AlignmentMode::kSim3, AlignmentMode::kYaw}) {
    EXPECT_NEAR(align(mode, points, mirrored).R_r_e.determinant(), 1.0, 1e-12) << to_name(mode);
  }
}

TEST(Alignment, PlanarPointsAreEnough) {
  std::vector<Vector3d> points = random_points(5, 30, 5.0);
  for (Vector3d& point : points) point.z() = 2.0;
  const Alignment truth = random_alignment(5, 1.0);
  EXPECT_LT((align(AlignmentMode::kSe3, points, moved(truth, points)).R_r_e - truth.R_r_e).norm(), 1e-12);
}

TEST(Alignment, YawNeverTilts) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Vector3d> points = random_points(seed, 30, 5.0);
    const std::vector<Vector3d> other = moved(random_alignment(seed, 1.0), points);
    const Matrix3d R = align(AlignmentMode::kYaw, points, other).R_r_e;
    EXPECT_LT((R * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 1e-15) << seed;
    EXPECT_LT((R * R.transpose() - Matrix3d::Identity()).norm(), 1e-14) << seed;
  }
}

TEST(Alignment, YawRecoversAnyHeading) {
  for (const double yaw : {-3.1, -1.0, 0.0, 0.4, 3.14}) {
    const Alignment truth{SO3::exp<double>(Vector3d(0.0, 0.0, yaw)), Vector3d(1.0, -2.0, 3.0), 1.0};
    const std::vector<Vector3d> points = random_points(6, 10, 5.0);
    const Alignment found = align(AlignmentMode::kYaw, points, moved(truth, points));
    EXPECT_LT((found.R_r_e - truth.R_r_e).norm(), 1e-12) << yaw;
    EXPECT_LT((found.p_r_e - truth.p_r_e).norm(), 1e-10) << yaw;
  }
}

/// No small change of any parameter that a mode may change makes the sum of squares smaller.
TEST(Alignment, IsALeastSquaresMinimum) {
  const std::vector<Vector3d> points = random_points(7, 25, 5.0);
  std::vector<Vector3d> other = moved(random_alignment(7, 1.3), points);
  const RandomStream random(7, "disturbance");
  for (std::size_t i = 0; i < other.size(); ++i) other[i] += 1.5 * random_vector(random, i);
  for (const AlignmentMode mode : {AlignmentMode::kSe3, AlignmentMode::kSim3, AlignmentMode::kYaw}) {
    const Alignment best = align(mode, points, other);
    const double least = cost(best, points, other);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-1e-3, 1e-3}) {
        Alignment shifted = best, turned = best, scaled = best;
        shifted.p_r_e(axis) += step;
        EXPECT_GT(cost(shifted, points, other), least);
        turned.R_r_e = SO3::exp<double>(step * Vector3d::Unit(axis)) * best.R_r_e;
        turned.p_r_e += (best.R_r_e - turned.R_r_e) * best.scale * points[0];
        if (mode != AlignmentMode::kYaw || axis == 2) {
          EXPECT_GT(cost(turned, points, other), least);
        }
        scaled.scale += step;
        if (mode == AlignmentMode::kSim3) {
          EXPECT_GT(cost(scaled, points, other), least);
        }
      }
    }
  }
}

TEST(Alignment, DegeneratePointsAreRefused) {
  std::vector<Vector3d> line, vertical;
  for (int i = 0; i < 10; ++i) {
    line.push_back(Vector3d(3.0, 1.0, 2.0) + i * Vector3d(0.3, -0.2, 0.7));
    vertical.push_back(Vector3d(3.0, 1.0, i));
  }
  const std::vector<Vector3d> same(10, Vector3d(3.0, 1.0, 2.0)), good = random_points(8, 10, 1.0);
  const std::vector<Vector3d> two(good.begin(), good.begin() + 2);
  for (const AlignmentMode mode : {AlignmentMode::kSe3, AlignmentMode::kSim3}) {
    EXPECT_EQ(error_code(mode, line, good), "E-ALIGN");
    EXPECT_EQ(error_code(mode, good, line), "E-ALIGN");
    EXPECT_EQ(error_code(mode, same, good), "E-ALIGN");
    EXPECT_EQ(error_code(mode, two, two), "E-ALIGN");
    EXPECT_EQ(error_code(mode, {}, {}), "E-ALIGN");
  }
  EXPECT_EQ(error_code(AlignmentMode::kYaw, vertical, good), "E-ALIGN");
  EXPECT_EQ(error_code(AlignmentMode::kYaw, line, line), "");
  EXPECT_THROW(align(AlignmentMode::kSe3, good, two), Error);
}

}  // namespace
}  // namespace vispline
