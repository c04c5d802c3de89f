/// Quaternions of a file -> rotations, with a word about those that are not of unit length.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "vispline/core/types.h"
#include "vispline/io/stamp_screen.h"

namespace vispline {

/// Rotation matrices of x y z w quaternions at kept rows. A norm off by more than 1e-3 is normalised with W-QUATERNION;
/// off by more than 0.1 is E-QUATERNION, or with --repair flags the row to be left out (`keep` becomes 0).
std::vector<Matrix3d> to_rotations(ReadContext& context, const std::vector<Eigen::Quaterniond>& quaternions,
                                   std::span<const SensorRow> rows, std::vector<std::uint8_t>& keep);

}  // namespace vispline
