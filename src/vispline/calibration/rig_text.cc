#include "vispline/calibration/rig_text.h"

#include "vispline/calibration/dialect_text.h"

namespace vispline::dialect {
namespace {

std::string row_text(const Eigen::MatrixXd& matrix, Eigen::Index row) {
  std::string text;
  for (Eigen::Index col = 0; col < matrix.cols(); ++col) text += (col ? ", " : "") + yaml_float(matrix(row, col));
  return text;
}

}  // namespace

std::string list(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + yaml_float(value);
  return text + "]";
}

std::string rows(const std::string& indent, const std::string& key, const Eigen::MatrixXd& matrix,
                 const std::string& comment) {
  std::string text = indent + key + ":" + (comment.empty() ? "" : "  # " + comment) + "\n";
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) text += indent + "  - [" + row_text(matrix, row) + "]\n";
  return text;
}

Eigen::MatrixXd matrix4(const Pose& T) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = T.R;
  matrix.topRightCorner<3, 1>() = T.p;
  return matrix;
}

std::string opencv_matrix(const std::string& key, const Pose& T, char type, const std::string& comment) {
  const Eigen::MatrixXd matrix = matrix4(T);
  std::string text =
      "# " + comment + "\n" + key + ": !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: " + type + "\n   data: [";
  for (Eigen::Index row = 0; row < 4; ++row) text += (row ? ",\n          " : "") + row_text(matrix, row);
  return text + "]\n";
}

}  // namespace vispline::dialect
