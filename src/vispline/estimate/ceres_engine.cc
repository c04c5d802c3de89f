#include "vispline/estimate/ceres_engine.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "vispline/core/se3.h"
#include "vispline/core/split_pose.h"
#include "vispline/estimate/ceres_evaluation.h"
#include "vispline/estimate/normal_equations.h"

namespace vispline {
namespace {

using through_ceres::Evaluation;
using through_ceres::Residuals;

constexpr int kMostDenseColumns = 1500;  // beyond, a sparse factor is faster

/// Unknowns x around the base state, perturbed on the right of where they are; derivatives are taken there as well.
class Perturbation final : public ceres::Manifold {
 public:
  using PlusOf = std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& delta)>;
  Perturbation(int size, PlusOf plus) : size_(size), plus_(std::move(plus)) {}
  int AmbientSize() const override { return size_; }
  int TangentSize() const override { return size_; }
  bool Plus(const double* x, const double* delta, double* next) const override {
    Eigen::Map<Eigen::VectorXd>(next, size_) =
        plus_(Eigen::Map<const Eigen::VectorXd>(x, size_), Eigen::Map<const Eigen::VectorXd>(delta, size_));
    return true;
  }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<Eigen::MatrixXd>(jacobian, size_, size_).setIdentity();
    return true;
  }
  /// Only the covariance of Ceres asks for these two.
  bool Minus(const double* /*y*/, const double* /*x*/, double* /*delta*/) const override { return false; }
  bool MinusJacobian(const double* /*x*/, double* /*jacobian*/) const override { return false; }

 private:
  int size_;
  PlusOf plus_;
};

template <class G>
Eigen::VectorXd plus_in(const Eigen::VectorXd& x, const Eigen::VectorXd& delta) {
  return G::template log<double>(
      G::template compose<double>(G::template exp<double>(Vector6d(x)), G::template exp<double>(Vector6d(delta))));
}

/// Coordinates around `base` of `landmark`: the inverse of moved().
Eigen::VectorXd coordinates(const InverseDepthLandmark& base, const InverseDepthLandmark& landmark, int size) {
  Eigen::VectorXd x(size);
  if (size == 3) {
    x.head<2>() =
        plane_across(base.bearing_c).transpose() * landmark.bearing_c / base.bearing_c.dot(landmark.bearing_c);
  }
  x(size - 1) = landmark.inverse_distance - base.inverse_distance;
  return x;
}

struct Block {
  int column, size;
};

/// One residual block: hands out what the evaluation made.
class Handed final : public ceres::CostFunction {
 public:
  Handed(const Residuals& source, std::vector<Block> blocks, bool landmark, bool& moved_out)
      : source_(source), blocks_(std::move(blocks)), moved_out_(moved_out) {
    set_num_residuals(static_cast<int>(source.r.size()));
    for (const Block& block : blocks_) mutable_parameter_block_sizes()->push_back(block.size);
    if (landmark) mutable_parameter_block_sizes()->push_back(static_cast<int>(source.J_landmark.cols()));
  }

  bool Evaluate(double const* const* /*unknowns*/, double* residuals, double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd>(residuals, source_.r.size()) = source_.r;
    if (!source_.r.allFinite()) return false;
    if (jacobians == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    std::size_t found = 0;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const auto at = std::find(source_.column.begin(), source_.column.end(), blocks_[b].column);
      const bool here = at != source_.column.end();
      if (here) found += static_cast<std::size_t>(blocks_[b].size);
      if (jacobians[b] == nullptr) continue;
      Eigen::Map<RowMajor> J(jacobians[b], source_.r.size(), blocks_[b].size);
      if (here) {
        J = source_.J.middleCols(at - source_.column.begin(), blocks_[b].size);
      } else {
        J.setZero();
      }
    }
    if (found < source_.column.size()) moved_out_ = true;
    const std::size_t landmark = blocks_.size();
    if (parameter_block_sizes().size() > landmark && jacobians[landmark] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[landmark], source_.r.size(), source_.J_landmark.cols()) = source_.J_landmark;
    }
    return true;
  }

 private:
  const Residuals& source_;
  std::vector<Block> blocks_;
  bool& moved_out_;
};

/// The problem of Ceres around one base state. Readings are bound to the knots that they need there.
class Binding {
 public:
  Binding(const Problem& problem, const Solution& solution, std::size_t threads)
      : problem_(problem),
        solution_(solution),
        evaluation_(problem, solution.state, solution.columns, solution.parameters, threads),
        light_(solution.state) {
    light_.curve = nullptr;
    light_.landmarks.clear();
    ceres::Problem::Options options;
    options.evaluation_callback = &evaluation_;
    options.enable_fast_removal = false;
    ceres_ = std::make_unique<ceres::Problem>(options);
    block_at_.assign(static_cast<std::size_t>(solution.columns.layout.columns), {0, 0});
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
    for (const Block& block : blocks_) ordering->AddElementToGroup(evaluation_.unknowns(block.column), 1);
    for (std::size_t t = 0; t < problem_.tracks.size(); ++t) ordering->AddElementToGroup(evaluation_.landmark(t), 0);
    return ordering;
  }

 private:
  void add_block(int column, int size, Perturbation::PlusOf plus) {
    ceres_->AddParameterBlock(evaluation_.unknowns(column), size,
                              plus ? new Perturbation(size, std::move(plus)) : nullptr);
    blocks_.push_back({column, size});
    for (int i = 0; i < size; ++i) block_at_[static_cast<std::size_t>(column + i)] = {column, size};
  }

  void add_unknowns() {
    const Layout& layout = solution_.columns.layout;
    const bool joint = solution_.state.curve->kind() == SplineKind::kJoint;
    for (const int column : layout.knot) add_block(column, 6, joint ? plus_in<SE3> : plus_in<SplitPose>);
    for (const auto& nodes : layout.bias) {
      for (const int column : nodes) add_block(column, 6, {});
    }
    for (const Parameter& parameter : solution_.parameters) {
      if (parameter.column < 0) continue;
      add_block(parameter.column, parameter.size, [&](const Eigen::VectorXd& x, const Eigen::VectorXd& delta) {
        State next = light_;
        parameter.move(next, x);
        parameter.move(next, delta);
        return parameter.delta(light_, next);
      });
    }
    const TrackModel& model = problem_.track_model;
    for (std::size_t t = 0; t < problem_.tracks.size(); ++t) {
      const InverseDepthLandmark base = solution_.state.landmarks[problem_.tracks[t].landmark];
      const auto plus = [base, &model](const Eigen::VectorXd& x, const Eigen::VectorXd& delta) {
        Vector3d first = Vector3d::Zero(), second = Vector3d::Zero();
        first.head(x.size()) = x;
        second.head(x.size()) = delta;
        return coordinates(base, moved(moved(base, model, first), model, second), model.size());
      };
      ceres_->AddParameterBlock(evaluation_.landmark(t), model.size(), new Perturbation(model.size(), plus));
    }
  }

  void add(const Residuals& residuals, double* landmark) {
    std::vector<Block> blocks;
    std::vector<double*> unknowns;
    for (const int column : residuals.column) {
      const Block& block = block_at_[static_cast<std::size_t>(column)];
      if (block.column != column) continue;
      blocks.push_back(block);
      unknowns.push_back(evaluation_.unknowns(column));
    }
    if (landmark != nullptr) unknowns.push_back(landmark);
    if (unknowns.empty()) return;
    ceres_->AddResidualBlock(new Handed(residuals, std::move(blocks), landmark != nullptr, moved_out_), nullptr,
                             unknowns);
  }

  void add_residuals() {
    for (const Residuals& residuals : evaluation_.measured()) add(residuals, nullptr);
    const bool exact = problem_.track_model.unknowns == LandmarkUnknowns::kInverseDepth;
    for (std::size_t t = 0; t < problem_.tracks.size(); ++t) {
      const std::vector<Residuals>& seen = evaluation_.seen()[t];
      for (std::size_t i = exact ? 1 : 0; i < seen.size(); ++i) add(seen[i], evaluation_.landmark(t));
    }
  }

  const Problem& problem_;
  const Solution& solution_;
  Evaluation evaluation_;
  State light_;  ///< the base state, as far as parameters look at it
  std::unique_ptr<ceres::Problem> ceres_;
  std::vector<Block> blocks_, block_at_;
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
    row.predicted = summary.relative_decrease > 0.0 ? summary.cost_change / summary.relative_decrease : 0.0;
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
  // Progress tells when to end, by the rule of our own solver.
  ceres.function_tolerance = ceres.gradient_tolerance = ceres.parameter_tolerance = 0.0;
  ceres.initial_trust_region_radius = 1.0 / options.first_lambda;
  ceres.logging_type = ceres::SILENT;
  ceres.num_threads = 1;  // more would change the order of its sums; the rows are made by options.threads
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
  for (bool again = true, first = true; again; first = false) {
    whiten(problem, solution.state, options.threads);
    if (first) solution.first_cost = cost_at(problem, solution.state, solution.columns, options.threads).cost;
    const std::size_t before = solution.iterations.size();
    Binding binding(problem, solution, options.threads);
    ceres::Solver::Options ceres = ceres_options(problem, options, binding, solution.columns.layout.columns,
                                                 options.max_iterations - static_cast<int>(before));
    ceres.callbacks.push_back(&progress);
    ceres::Solver::Summary summary;
    ceres::Solve(ceres, &binding.ceres(), &summary);
    solution.status = status_of(summary, progress);
    if (solution.status != SolveStatus::kFailed) solution.state = binding.state();
    const bool moved = binding.moved_out() || solution.iterations.size() > before + 1;
    again = moved && solution.status == SolveStatus::kConverged;
  }
  const CostAt at = cost_at(problem, solution.state, solution.columns, options.threads);
  solution.cost = at.cost;
  solution.lost = at.lost;
}

}  // namespace vispline
