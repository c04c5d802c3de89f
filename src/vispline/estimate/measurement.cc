#include "vispline/estimate/measurement.h"

#include <cmath>

namespace vispline {

double Huber::loss(double s) const {
  if (width <= 0.0 || s <= width * width) return s;
  return 2.0 * width * std::sqrt(s) - width * width;
}

double Huber::weight(double s) const {
  if (width <= 0.0 || s <= width * width) return 1.0;
  return width / std::sqrt(s);
}

void Rows::start(Eigen::Index rows) {
  r.setZero(rows);
  weight.setOnes(rows);
  chain.resize(0, 0);
  column.clear();
  cost = 0.0;
  lost = 0;
}

Eigen::MatrixXd Rows::pull(const Eigen::MatrixXd& B) const {
  const Eigen::MatrixXd pulled = J.transpose() * B;
  return chain.size() == 0 ? pulled : Eigen::MatrixXd(chain.transpose() * pulled);
}

int Rows::append(int first_column, int size) {
  if (first_column < 0) return -1;
  const int local = static_cast<int>(column.size());
  for (int i = 0; i < size; ++i) column.push_back(first_column + i);
  return local;
}

KnotColumns append_knots(const Curve& curve, const Layout& layout, std::size_t first, std::size_t last_first,
                         Rows& rows) {
  const auto local = static_cast<int>(rows.column.size());
  for (std::size_t k = first; k < last_first + static_cast<std::size_t>(curve.order()); ++k) {
    rows.append(layout.knot[k], 6);
  }
  return {first, local};
}

}  // namespace vispline
