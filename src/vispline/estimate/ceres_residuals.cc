#include "vispline/estimate/ceres_residuals.h"

#include <algorithm>
#include <cmath>

namespace vispline::through_ceres {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Blocks that the columns of some rows stand in, in the order of their first column.
std::vector<std::size_t> blocks_of(const std::vector<int>& columns, const Unknowns& unknowns) {
  std::vector<std::size_t> blocks;
  for (const int column : columns) {
    const std::size_t block = unknowns.place(column).block;
    if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
  }
  return blocks;
}

/// What the rows r, already weighted, leave of a cost: zero where it is rounding.
double remainder(double cost, double squares) {
  const double rest = 2.0 * cost - squares;
  return rest > 1e-12 * cost ? std::sqrt(rest) : 0.0;
}

}  // namespace

Handed::Handed(int rows, const std::vector<int>& columns, Unknowns& unknowns, bool& moved_out)
    : unknowns_(unknowns), blocks_(blocks_of(columns, unknowns)), moved_out_(moved_out) {
  set_num_residuals(rows);
  for (const std::size_t block : blocks_) {
    mutable_parameter_block_sizes()->push_back(unknowns.blocks()[block].size);
  }
}

std::vector<double*> Handed::bound() const {
  std::vector<double*> x;
  for (const std::size_t block : blocks_) x.push_back(unknowns_.blocks()[block].x);
  return x;
}

void Handed::hand_out(const std::vector<int>& column, const Eigen::Ref<const Eigen::MatrixXd>& J,
                      double** jacobians) const {
  const Eigen::Index rows = num_residuals();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (jacobians[b] != nullptr) std::fill_n(jacobians[b], rows * parameter_block_sizes()[b], 0.0);
  }
  std::size_t b = 0;
  for (std::size_t c = 0; c < column.size(); ++c) {
    const Place& place = unknowns_.place(column[c]);
    if (b == blocks_.size() || blocks_[b] != place.block) {
      b = static_cast<std::size_t>(std::find(blocks_.begin(), blocks_.end(), place.block) - blocks_.begin());
    }
    if (b == blocks_.size()) moved_out_ = true;
    if (b == blocks_.size() || jacobians[b] == nullptr) continue;
    Eigen::Map<RowMajor> out(jacobians[b], rows, parameter_block_sizes()[b]);
    out.col(place.offset).head(J.rows()) += J.col(static_cast<Eigen::Index>(c));
  }
}

HandedRows::HandedRows(const Rows& source, Unknowns& unknowns, bool& moved_out)
    : Handed(static_cast<int>(source.r.size()) + 1, source.column, unknowns, moved_out), source_(source) {}

bool HandedRows::Evaluate(double const* const* /*x*/, double* residuals, double** jacobians) const {
  const Eigen::Index n = source_.r.size();
  const Eigen::VectorXd root = source_.weight.cwiseSqrt();
  Eigen::Map<Eigen::VectorXd> r(residuals, n + 1);
  r.head(n) = root.cwiseProduct(source_.r);
  r(n) = remainder(source_.cost, r.head(n).squaredNorm());
  if (jacobians != nullptr) hand_out(source_.column, root.asDiagonal() * source_.jacobian(), jacobians);
  return r.allFinite();
}

HandedSighting::HandedSighting(const SightingRows& source, int landmark, Unknowns& unknowns, bool& moved_out)
    : Handed(2, source.column, unknowns, moved_out), source_(source) {
  mutable_parameter_block_sizes()->push_back(landmark);
}

bool HandedSighting::Evaluate(double const* const* /*x*/, double* residuals, double** jacobians) const {
  Eigen::Map<Vector2d> r(residuals);
  r = source_.r;
  if (jacobians == nullptr) return r.allFinite();
  const bool lost = source_.lost;  // its derivatives are those of before
  hand_out(lost ? std::vector<int>() : source_.column, source_.J, jacobians);
  if (double* J_landmark = jacobians[blocks()]; J_landmark != nullptr) {
    const int size = parameter_block_sizes().back();
    Eigen::Map<RowMajor>(J_landmark, 2, size) = (lost ? 0.0 : 1.0) * source_.J_landmark.leftCols(size);
  }
  return r.allFinite();
}

TrackRemainder::TrackRemainder(const std::vector<SightingRows>& seen, const TrackModel& model)
    : seen_(seen), model_(model) {
  set_num_residuals(1);
  mutable_parameter_block_sizes()->push_back(model.size());
}

bool TrackRemainder::Evaluate(double const* const* /*x*/, double* residuals, double** jacobians) const {
  double sum = 0.0;
  for (const SightingRows& rows : seen_) {
    const double e = remainder(0.5 * model_.loss.loss(rows.squares), rows.r.squaredNorm());
    sum += e * e;
  }
  residuals[0] = std::sqrt(sum);
  if (jacobians != nullptr && jacobians[0] != nullptr) std::fill_n(jacobians[0], model_.size(), 0.0);
  return std::isfinite(sum);
}

}  // namespace vispline::through_ceres
