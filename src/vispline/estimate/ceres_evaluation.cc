#include "vispline/estimate/ceres_evaluation.h"

#include <cmath>

#include "vispline/core/parallel.h"

namespace vispline::through_ceres {
namespace {

/// What the rows r leave of a cost, as one row: zero where it is rounding.
double remainder(double cost, double squares) {
  const double rest = 2.0 * cost - squares;
  return rest > 1e-12 * cost ? std::sqrt(rest) : 0.0;
}

void take(const Rows& rows, bool derivatives, Residuals& out) {
  const Eigen::Index n = rows.r.size();
  const Eigen::VectorXd root = rows.weight.cwiseSqrt();
  out.column = rows.column;
  out.r.resize(n + 1);
  out.r.head(n) = root.cwiseProduct(rows.r);
  out.r(n) = remainder(rows.cost, out.r.head(n).squaredNorm());
  if (!derivatives) return;
  out.J.setZero(n + 1, static_cast<Eigen::Index>(rows.column.size()));
  out.J.topRows(n) = root.asDiagonal() * rows.jacobian();
}

void take(const SightingRows& rows, const TrackModel& model, Residuals& out) {
  const double root = std::sqrt(rows.weight);
  const double s = rows.lost ? kLostSigmas * kLostSigmas : rows.r.squaredNorm();
  out.column = rows.column;
  out.r.resize(3);
  out.r.head<2>() = root * rows.r;
  out.r(2) = remainder(0.5 * model.loss.loss(s), out.r.head<2>().squaredNorm());
  out.J.setZero(3, rows.J.cols());
  out.J.topRows<2>() = root * rows.J;
  out.J_landmark.setZero(3, model.size());
  out.J_landmark.topRows<2>() = root * rows.J_landmark.leftCols(model.size());
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
