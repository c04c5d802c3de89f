#include "vispline/estimate/ceres_evaluation.h"

#include <algorithm>
#include <utility>

#include "vispline/core/parallel.h"

namespace vispline::through_ceres {
namespace {

/// Ceres spends its time on pairs of blocks, and each view has zeros where a block reaches beyond its knots.
constexpr std::size_t kKnotsPerBlock = 2;

std::vector<int> consecutive(int first, int size) {
  std::vector<int> columns;
  for (int i = 0; i < size; ++i) columns.push_back(first + i);
  return columns;
}

}  // namespace

Unknowns::Unknowns(const Columns& columns, const std::vector<Parameter>& parameters, std::size_t tracks)
    : x_(static_cast<std::size_t>(columns.layout.columns), 0.0),
      place_(x_.size()),
      landmarks_(tracks, Vector3d::Zero()) {
  const std::vector<int>& knot = columns.layout.knot;
  for (std::size_t first = 0; first < knot.size(); first += kKnotsPerBlock) {
    std::vector<int> together;
    for (std::size_t k = first; k < std::min(knot.size(), first + kKnotsPerBlock); ++k) {
      const std::vector<int> own = consecutive(knot[k], 6);
      together.insert(together.end(), own.begin(), own.end());
    }
    add(together);
  }
  for (const auto& nodes : columns.layout.bias) {
    for (const int column : nodes) add(consecutive(column, 6));
  }
  for (const Parameter& parameter : parameters) {
    if (parameter.column >= 0) add(consecutive(parameter.column, parameter.size));
  }
}

void Unknowns::add(const std::vector<int>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    place_[static_cast<std::size_t>(columns[i])] = {blocks_.size(), static_cast<int>(i)};
  }
  blocks_.push_back({x_.data() + column_.size(), static_cast<int>(columns.size())});
  column_.insert(column_.end(), columns.begin(), columns.end());
}

Eigen::VectorXd Unknowns::by_column() const {
  Eigen::VectorXd delta(static_cast<Eigen::Index>(x_.size()));
  for (std::size_t i = 0; i < x_.size(); ++i) delta(column_[i]) = x_[i];
  return delta;
}

Evaluation::Evaluation(Problem& problem, const State& start, const Columns& columns,
                       const std::vector<Parameter>& parameters, std::size_t threads)
    : problem_(problem),
      columns_(columns),
      parameters_(parameters),
      threads_(threads),
      unknowns_(columns, parameters, problem.tracks.size()),
      linearized_(start),
      x_linearized_(unknowns_.by_column()),
      landmarks_linearized_(unknowns_.landmarks()),
      measured_(problem.measurements.size()),
      seen_(problem.tracks.size()) {
  evaluate(true);
}

State Evaluation::state() const {
  std::vector<Vector3d> landmarks = unknowns_.landmarks();
  for (std::size_t t = 0; t < landmarks.size(); ++t) landmarks[t] -= landmarks_linearized_[t];
  return moved(linearized_, columns_, parameters_, unknowns_.by_column() - x_linearized_, problem_, landmarks);
}

void Evaluation::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  if (!std::exchange(untouched_, false) && (new_evaluation_point || evaluate_jacobians)) evaluate(evaluate_jacobians);
}

void Evaluation::evaluate(bool derivatives) {
  State now = state();
  whiten_measurements(problem_, now, threads_);
  parallel_for(measured_.size(), threads_,
               [&](std::size_t m) { problem_.measurements[m]->evaluate(now, columns_, derivatives, measured_[m]); });
  parallel_for(seen_.size(), threads_, [&](std::size_t t) {
    evaluate_sightings(now, columns_, problem_.track_model, problem_.tracks[t], derivatives, seen_[t]);
  });
  if (!derivatives) return;
  linearized_ = std::move(now);
  x_linearized_ = unknowns_.by_column();
  landmarks_linearized_ = unknowns_.landmarks();
}

}  // namespace vispline::through_ceres
