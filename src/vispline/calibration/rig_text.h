/// Matrices and lists as text, shared by the writers of rigs.
#pragma once

#include <string>
#include <vector>

#include "vispline/calibration/rig_calibration.h"

namespace vispline::dialect {

/// [1.0, 2.0]
std::string list(const std::vector<double>& values);
/// `indent``key`:  # comment, then one row a line.
std::string rows(const std::string& indent, const std::string& key, const Eigen::MatrixXd& matrix,
                 const std::string& comment);
Eigen::MatrixXd matrix4(const Pose& T);
/// `key`: !!opencv-matrix, with `type` "d" or "f".
std::string opencv_matrix(const std::string& key, const Pose& T, char type, const std::string& comment);

}  // namespace vispline::dialect
