#include "vispline/estimate/ceres_evaluation.h"

#include <cmath>

#include "vispline/core/parallel.h"

namespace vispline::through_ceres {
namespace {

/// Factor of a residual whose robust weight is w.
double factor(double w) { return std::sqrt(w * (2.0 - w)); }

/// The last row holds what the readings cost that cannot be predicted here.
void take(const Rows& rows, bool derivatives, Residuals& out) {
  const Eigen::Index n = rows.r.size();
  const Eigen::VectorXd f = rows.weight.unaryExpr(&factor);
  out.column = rows.column;
  out.r.resize(n + 1);
  out.r.head(n) = f.cwiseProduct(rows.r);
  out.r(n) = std::sqrt(std::max(0.0, 2.0 * rows.cost - out.r.head(n).squaredNorm()));
  if (rows.lost == 0) out.r(n) = 0.0;
  if (!derivatives) return;
  out.J.setZero(n + 1, rows.J.cols());
  out.J.topRows(n) = rows.weight.cwiseQuotient(f).asDiagonal() * rows.J;
}

void take(const SightingRows& rows, const TrackModel& model, Residuals& out) {
  const double f = factor(rows.weight);
  out.column = rows.column;
  out.r.setZero(3);
  out.r.head<2>() = f * rows.r;
  if (rows.lost) out.r(2) = std::sqrt(model.loss.loss(kLostSigmas * kLostSigmas));
  out.J.setZero(3, rows.J.cols());
  out.J.topRows<2>() = rows.weight / f * rows.J;
  out.J_landmark.setZero(3, model.size());
  out.J_landmark.topRows<2>() = rows.weight / f * rows.J_landmark.leftCols(model.size());
}

}  // namespace

Evaluation::Evaluation(const Problem& problem, const State& base, const Columns& columns,
                       const std::vector<Parameter>& parameters, std::size_t threads)
    : problem_(problem),
      base_(base),
      columns_(columns),
      parameters_(parameters),
      threads_(threads),
      x_(Eigen::VectorXd::Zero(columns.layout.columns)),
      x_landmark_(problem.tracks.size(), Vector3d::Zero()),
      measured_(problem.measurements.size()),
      seen_(problem.tracks.size()) {
  evaluate(true);
}

State Evaluation::state() const { return moved(base_, columns_, parameters_, x_, problem_, x_landmark_); }

void Evaluation::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  if (new_evaluation_point || evaluate_jacobians) evaluate(evaluate_jacobians);
}

void Evaluation::evaluate(bool derivatives) {
  const State now = state();
  parallel_for(measured_.size(), threads_, [&](std::size_t m) {
    Rows rows;
    problem_.measurements[m]->evaluate(now, columns_, derivatives, rows);
    take(rows, derivatives, measured_[m]);
  });
  parallel_for(seen_.size(), threads_, [&](std::size_t t) {
    const std::vector<SightingRows> rows = linearize_sightings(now, columns_, problem_.track_model, problem_.tracks[t]);
    seen_[t].resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) take(rows[i], problem_.track_model, seen_[t][i]);
  });
}

}  // namespace vispline::through_ceres
