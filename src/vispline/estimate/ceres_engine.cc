#include "vispline/estimate/ceres_engine.h"

#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "vispline/estimate/ceres_residuals.h"
#include "vispline/estimate/normal_equations.h"

namespace vispline {
namespace {

using through_ceres::Block;
using through_ceres::Evaluation;
using through_ceres::HandedRows;
using through_ceres::HandedSighting;
using through_ceres::TrackRemainder;
using through_ceres::Unknowns;

constexpr int kMostDenseColumns = 1500;  // beyond, a sparse factor is faster

/// The problem of Ceres from one state on. Readings are bound to the knots that they need there.
class Binding {
 public:
  Binding(Problem& problem, const Solution& solution, std::size_t threads)
      : problem_(problem), evaluation_(problem, solution.state, solution.columns, solution.parameters, threads) {
    ceres::Problem::Options options;
    options.evaluation_callback = &evaluation_;
    options.enable_fast_removal = false;
    options.disable_all_safety_checks = true;
    ceres_ = std::make_unique<ceres::Problem>(options);
    add_unknowns();
    add_residuals();
  }

  ceres::Problem& ceres() { return *ceres_; }
  State state() const { return evaluation_.state(); }
  /// A reading moved to knots that it was not bound to: its derivatives there are missing.
  bool moved_out() const { return moved_out_; }
  /// Landmarks first.
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering() {
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    for (const Block& block : unknowns().blocks()) ordering->AddElementToGroup(block.x, 1);
    for (std::size_t t = 0; t < problem_.tracks.size(); ++t) ordering->AddElementToGroup(unknowns().landmark(t), 0);
    return ordering;
  }

 private:
  Unknowns& unknowns() { return evaluation_.unknowns(); }

  void add_unknowns() {
    for (const Block& block : unknowns().blocks()) ceres_->AddParameterBlock(block.x, block.size);
    for (std::size_t t = 0; t < problem_.tracks.size(); ++t) {
      ceres_->AddParameterBlock(unknowns().landmark(t), problem_.track_model.size());
    }
  }

  void add_residuals() {
    for (const Rows& rows : evaluation_.measured()) {
      if (rows.column.empty()) continue;
      auto* handed = new HandedRows(rows, unknowns(), moved_out_);
      ceres_->AddResidualBlock(handed, nullptr, handed->bound());
    }
    const bool exact = problem_.track_model.unknowns == LandmarkUnknowns::kInverseDepth;
    for (std::size_t t = 0; t < problem_.tracks.size(); ++t) {
      const std::vector<SightingRows>& seen = evaluation_.seen()[t];
      for (std::size_t i = exact ? 1 : 0; i < seen.size(); ++i) {
        auto* handed = new HandedSighting(seen[i], problem_.track_model.size(), unknowns(), moved_out_);
        std::vector<double*> x = handed->bound();
        x.push_back(unknowns().landmark(t));
        ceres_->AddResidualBlock(handed, nullptr, x);
      }
      ceres_->AddResidualBlock(new TrackRemainder(seen, problem_.track_model), nullptr, {unknowns().landmark(t)});
    }
  }

  Problem& problem_;
  Evaluation evaluation_;
  std::unique_ptr<ceres::Problem> ceres_;
  bool moved_out_ = false;
};

class Progress final : public ceres::IterationCallback {
 public:
  Progress(const SolveOptions& options, Solution& solution) : options_(options), solution_(solution) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    IterationRow row;
    row.iteration = static_cast<int>(solution_.iterations.size()) + 1;
    row.cost = summary.cost;
    row.decrease = summary.cost_change;
    row.predicted = summary.relative_decrease == 0.0 ? 0.0 : summary.cost_change / summary.relative_decrease;
    row.lambda = 1.0 / summary.trust_region_radius;
    row.accepted = summary.step_is_successful;
    solution_.iterations.push_back(row);
    const double little = std::max(options_.least_decrease, options_.relative_decrease * row.cost);
    converged_ = summary.step_is_valid && row.predicted < little;
    stopped_ = options_.progress && !options_.progress(row) && !converged_;
    return stopped_ || converged_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  bool stopped() const { return stopped_; }
  bool converged() const { return converged_; }

 private:
  const SolveOptions& options_;
  Solution& solution_;
  bool stopped_ = false, converged_ = false;
};

ceres::Solver::Options ceres_options(const Problem& problem, const SolveOptions& options, Binding& binding, int columns,
                                     int iterations_left) {
  ceres::Solver::Options ceres;
  ceres.max_num_iterations = iterations_left;
  // A last step that gains less is found before its derivatives are, and not taken. Otherwise Progress tells when to end.
  ceres.function_tolerance = options.relative_decrease;
  ceres.gradient_tolerance = ceres.parameter_tolerance = 0.0;
  ceres.initial_trust_region_radius = 1.0 / options.first_lambda;
  ceres.logging_type = ceres::SILENT;
  ceres.jacobi_scaling = false;  // the damping has the scale of every unknown already
  ceres.num_threads = 1;         // more would change the order of its sums; the rows are made by options.threads
  const bool dense = !problem.tracks.empty() && columns < kMostDenseColumns;
  ceres.linear_solver_type = dense ? ceres::DENSE_SCHUR : ceres::SPARSE_NORMAL_CHOLESKY;
  if (dense) ceres.linear_solver_ordering = binding.ordering();
  return ceres;
}

SolveStatus status_of(const ceres::Solver::Summary& summary, const Progress& progress) {
  if (progress.stopped()) return SolveStatus::kStopped;
  if (progress.converged() || summary.termination_type == ceres::CONVERGENCE) return SolveStatus::kConverged;
  return summary.termination_type == ceres::NO_CONVERGENCE ? SolveStatus::kIterationLimit : SolveStatus::kFailed;
}

}  // namespace

void minimize_with_ceres(Problem& problem, const SolveOptions& options, Solution& solution) {
  Progress progress(options, solution);
  for (bool first = true, again = true; again; first = false) {
    Binding binding(problem, solution, options.threads);
    ceres::Solver::Options ceres = ceres_options(problem, options, binding, solution.columns.layout.columns,
                                                 options.max_iterations - static_cast<int>(solution.iterations.size()));
    ceres.callbacks.push_back(&progress);
    ceres::Solver::Summary summary;
    ceres::Solve(ceres, &binding.ceres(), &summary);
    if (first) solution.first_cost = summary.initial_cost;
    solution.status = status_of(summary, progress);
    if (solution.status != SolveStatus::kFailed) solution.state = binding.state();
    again = binding.moved_out() && solution.status == SolveStatus::kConverged;
  }
  whiten(problem, solution.state, options.threads);
  const CostAt at = cost_at(problem, solution.state, solution.columns, options.threads);
  solution.cost = at.cost;
  solution.lost = at.lost;
}

}  // namespace vispline
