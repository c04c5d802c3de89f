#include "vispline/io/rotations.h"

#include <cmath>
#include <string>

#include "vispline/io/number_text.h"

namespace vispline {
namespace {
constexpr double kRounding = 1e-3;  ///< of the norm, as text with few digits has
constexpr double kNoRotation = 0.1;
}  // namespace

std::vector<Matrix3d> to_rotations(ReadContext& context, const std::vector<Eigen::Quaterniond>& quaternions,
                                   std::span<const SensorRow> rows, std::vector<std::uint8_t>& keep) {
  std::vector<Matrix3d> rotations(quaternions.size(), Matrix3d::Identity());
  for (std::size_t i = 0; i < quaternions.size(); ++i) {
    const double norm = quaternions[i].norm();
    const bool broken = std::abs(norm - 1.0) > kNoRotation;
    const std::string found = "the quaternion has norm " + brief(norm);
    if (broken && !context.options().repair) {
      context.fail(ExitCode::kInput, "E-QUATERNION", found + ", not 1", context.where_line(rows[i].where),
                   "check the order of the columns (--columns), or pass --repair to leave such rows out");
    }
    if (broken) {
      keep[i] = 0;
      context.drop("W-QUATERNION", found + ", not 1", context.where_line(rows[i].where));
      continue;
    }
    if (std::abs(norm - 1.0) > kRounding) {
      context.warn("W-QUATERNION", found, context.where_line(rows[i].where), "it is normalised");
    }
    rotations[i] = quaternions[i].normalized().toRotationMatrix();
  }
  return rotations;
}

}  // namespace vispline
