/// Residual blocks of Ceres that hand out what an Evaluation made. docs/math/estimate.md, The solver.
#pragma once

#include <ceres/cost_function.h>

#include "vispline/estimate/ceres_evaluation.h"

namespace vispline::through_ceres {

/// Bound to the blocks of unknowns that its rows need when it is made.
class Handed : public ceres::CostFunction {
 public:
  std::vector<double*> bound() const;

 protected:
  Handed(int rows, const std::vector<int>& columns, Unknowns& unknowns, bool& moved_out);
  /// Adds J, whose columns are `column` of the system, to the blocks of Ceres, of which null ones are not wanted.
  void hand_out(const std::vector<int>& column, const Eigen::Ref<const Eigen::MatrixXd>& J, double** jacobians) const;
  std::size_t blocks() const { return blocks_.size(); }

 private:
  Unknowns& unknowns_;
  std::vector<std::size_t> blocks_;
  bool& moved_out_;  ///< set where rows need another block than those bound
};

/// With w the robust weight rho', a row r counts as sqrt(w) r, and so do its derivatives: the gradient is exact, the
/// curvature that of our own solver. What is left of the cost, sum(rho - w r^2) >= 0 and readings that cannot be
/// predicted, is one row more, which has no derivatives.
class HandedRows final : public Handed {
 public:
  HandedRows(const Rows& source, Unknowns& unknowns, bool& moved_out);
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;

 private:
  const Rows& source_;
};

/// The same for one sighting, whose last block is the landmark; its remainder is in that of the track.
class HandedSighting final : public Handed {
 public:
  HandedSighting(const SightingRows& source, int landmark, Unknowns& unknowns, bool& moved_out);
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;

 private:
  const SightingRows& source_;
};

/// What the rows of a track leave of its cost, on the landmark, by which it has no derivatives.
class TrackRemainder final : public ceres::CostFunction {
 public:
  TrackRemainder(const std::vector<SightingRows>& seen, const TrackModel& model);
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override;

 private:
  const std::vector<SightingRows>& seen_;
  const TrackModel& model_;
};

}  // namespace vispline::through_ceres
