#include "vispline/estimate/normal_equations.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "vispline/core/parallel.h"
#include "vispline/estimate/track_columns.h"
#include "vispline/estimate/view_sums.h"

namespace vispline {
namespace {

constexpr std::size_t kChunks = 4;
constexpr std::size_t kTrackChunks = 2;  ///< each has sums of its own

struct ChunkRange {
  std::size_t begin, end;
  ChunkRange(std::size_t count, std::size_t chunk, std::size_t chunks = kChunks)
      : begin(count * chunk / chunks), end(count * (chunk + 1) / chunks) {}
};

Eigen::VectorXd damping(const Skyline& H, double lambda) {
  return lambda * H.diagonal().cwiseMax(NormalEquations::kLeastInformation);
}

template <int kSize>
Eigen::Matrix<double, kSize, 1> landmark_damping(const TrackBlock& track, double lambda) {
  return lambda * track.H_l.diagonal().head<kSize>().cwiseMax(NormalEquations::kLeastInformation);
}

/// J^T W J of all columns; the lower triangle counts.
Eigen::MatrixXd information(const Rows& rows) {
  const Eigen::MatrixXd J_t = (rows.weight.cwiseSqrt().asDiagonal() * rows.J).transpose();
  const int size = static_cast<int>(J_t.rows());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  tiles::add_symmetric_product({J_t.data(), size}, {J_t.data(), size}, size, static_cast<int>(J_t.cols()),
                               {H.data(), size});
  if (rows.chain.size() == 0) return H;
  return rows.chain.transpose() * (H.selfadjointView<Eigen::Lower>() * rows.chain);
}

/// Of one measurement, by its own columns.
struct LocalEquations {
  std::vector<int> column{};
  Eigen::MatrixXd H{};
  Eigen::VectorXd g{};
  double cost = 0.0;
  std::size_t lost = 0;
};

std::vector<LocalEquations> linearize_measurements(const Problem& problem, const State& state, const Columns& columns,
                                                   std::size_t threads) {
  std::vector<LocalEquations> local(problem.measurements.size());
  parallel_for(kChunks, threads, [&](std::size_t chunk) {
    Rows rows;
    const ChunkRange range(local.size(), chunk);
    for (std::size_t m = range.begin; m < range.end; ++m) {
      problem.measurements[m]->evaluate(state, columns, true, rows);
      local[m] = {rows.column, information(rows), rows.pull(rows.weight.cwiseProduct(rows.r)), rows.cost, rows.lost};
    }
  });
  return local;
}

}  // namespace

CostAt cost_at(const Problem& problem, const State& state, const Columns& columns, std::size_t threads) {
  std::vector<CostAt> part(kChunks);
  parallel_for(kChunks, threads, [&](std::size_t chunk) {
    Rows rows;
    const ChunkRange measured(problem.measurements.size(), chunk), tracked(problem.tracks.size(), chunk);
    for (std::size_t m = measured.begin; m < measured.end; ++m) {
      problem.measurements[m]->evaluate(state, columns, false, rows);
      part[chunk].cost += rows.cost;
      part[chunk].lost += rows.lost;
    }
    for (std::size_t t = tracked.begin; t < tracked.end; ++t) {
      const TrackResiduals residuals = evaluate_track(state, problem.track_model, problem.tracks[t]);
      part[chunk].cost += residuals.cost;
      part[chunk].lost += residuals.lost;
    }
  });
  CostAt sum;
  for (const CostAt& p : part) {
    sum.cost += p.cost;
    sum.lost += p.lost;
  }
  return sum;
}

NormalEquations::NormalEquations(const Problem& problem, const State& state, const Columns& columns,
                                 std::size_t threads, Weights weights)
    : unknowns_(problem.track_model.unknowns), H_(columns.layout.columns), tracks_(problem.tracks.size()) {
  std::vector<LocalEquations> measured = linearize_measurements(problem, state, columns, threads);
  std::vector<TrackColumns> local;
  for (const Track& track : problem.tracks) local.emplace_back(state, columns, track);
  for (const LocalEquations& m : measured) H_.couple(m.column);
  for (const TrackColumns& track : local) H_.couple(track.column());
  H_.allocate();
  g_.setZero(columns.layout.columns);
  for (const LocalEquations& m : measured) {
    H_.add(m.column, m.H);
    g_(m.column) += m.g;
    cost_ += m.cost;
    lost_ += m.lost;
  }
  std::vector<ViewSums> views(problem.tracks.empty() ? 0 : kTrackChunks, ViewSums(state, columns));
  parallel_for(views.size(), threads, [&](std::size_t chunk) {
    const ChunkRange range(local.size(), chunk, views.size());
    for (std::size_t t = range.begin; t < range.end; ++t) {
      tracks_[t] =
          linearize_track(state, columns, local[t], problem.track_model, problem.tracks[t], weights, views[chunk]);
    }
  });
  for (const ViewSums& sums : views) sums.add_to(H_);
  for (const TrackBlock& track : tracks_) {
    if (track.C.size() > 0) H_.add_products(track.column, track.C, track.reference, track.Q);
    g_(track.column) += track.g;
    cost_ += track.cost;
    lost_ += track.lost;
  }
}

NormalEquations NormalEquations::renewed(Problem& problem, const State& state, const Columns& columns,
                                         std::size_t threads) {
  whiten_measurements(problem, state, threads);
  NormalEquations equations(problem, state, columns, threads, Weights::kRenewed);
  for (std::size_t t = 0; t < problem.tracks.size(); ++t) {
    problem.tracks[t].whitening = std::move(equations.tracks_[t].whitening);
  }
  return equations;
}

template <int kSize>
bool NormalEquations::eliminate(double lambda, Reduced& reduced) const {
  using Square = Eigen::Matrix<double, kSize, kSize>;
  ProductPanel panel(reduced.H);
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const TrackBlock& track = tracks_[t];
    Square H_l = track.H_l.topLeftCorner<kSize, kSize>();
    H_l.diagonal() += landmark_damping<kSize>(track, lambda);
    const Eigen::LLT<Square> cholesky(H_l);
    if (cholesky.info() != Eigen::Success) return false;
    const Square L_inverse = cholesky.matrixL().solve(Square::Identity());
    reduced.L_inverse[t].topLeftCorner<kSize, kSize>() = L_inverse;
    const Eigen::Matrix<double, Eigen::Dynamic, kSize> P_t = track.W_t.lazyProduct(L_inverse.transpose());
    panel.add(track.column, P_t);
    reduced.g(track.column) -= P_t.lazyProduct(L_inverse * track.g_l.head<kSize>());
  }
  panel.flush();
  return true;
}

NormalEquations::Reduced NormalEquations::reduce(double lambda) const {
  Reduced reduced{H_, g_, std::vector<Eigen::Matrix3d>(tracks_.size()), true};
  if (lambda > 0.0) reduced.H.add_to_diagonal(damping(H_, lambda));
  const bool point = unknowns_ == LandmarkUnknowns::kPoint;
  reduced.positive = (point ? eliminate<3>(lambda, reduced) : eliminate<1>(lambda, reduced)) && reduced.H.factor();
  return reduced;
}

template <int kSize>
double NormalEquations::substitute_of(double lambda, const Reduced& reduced, bool gradient, Step& step) const {
  using Vector = Eigen::Matrix<double, kSize, 1>;
  double sum = 0.0;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const TrackBlock& track = tracks_[t];
    Vector rhs = Vector::Zero();
    if (gradient) rhs = -track.g_l.head<kSize>();
    rhs -= (track.W_t.transpose() * Eigen::VectorXd(step.delta(track.column))).head<kSize>();
    const Eigen::Matrix<double, kSize, kSize> L_inverse = reduced.L_inverse[t].topLeftCorner<kSize, kSize>();
    Vector delta = L_inverse.transpose() * (L_inverse * rhs);
    sum += delta.dot(landmark_damping<kSize>(track, lambda).cwiseProduct(delta) - track.g_l.head<kSize>());
    if (track.carry_t.size() > 0)
      delta -= (track.carry_t.transpose() * Eigen::VectorXd(step.delta(track.reference))).head<kSize>();
    step.delta_landmark[t].head<kSize>() = delta;
  }
  return sum;
}

double NormalEquations::substitute(double lambda, const Reduced& reduced, bool gradient, Step& step) const {
  step.delta_landmark.assign(tracks_.size(), Vector3d::Zero());
  const bool point = unknowns_ == LandmarkUnknowns::kPoint;
  return point ? substitute_of<3>(lambda, reduced, gradient, step) : substitute_of<1>(lambda, reduced, gradient, step);
}

std::optional<Step> NormalEquations::step(double lambda) const {
  const Reduced reduced = reduce(lambda);
  if (!reduced.positive) return std::nullopt;
  Step step;
  step.delta = reduced.H.solve(-reduced.g);
  if (!step.delta.allFinite()) return std::nullopt;
  const double landmarks = substitute(lambda, reduced, true, step);
  step.predicted = 0.5 * (step.delta.dot(damping(H_, lambda).cwiseProduct(step.delta) - g_) + landmarks);
  return step;
}

std::optional<Eigen::MatrixXd> NormalEquations::solve(const Eigen::MatrixXd& B) const {
  const Reduced reduced = reduce(0.0);
  if (!reduced.positive) return std::nullopt;
  return reduced.H.solve(B);
}

std::vector<Step> NormalEquations::respond(const Eigen::MatrixXd& push) const {
  const Reduced reduced = reduce(0.0);
  std::vector<Step> steps;
  if (!reduced.positive) return steps;
  const Eigen::MatrixXd delta = reduced.H.solve(push);
  for (Eigen::Index i = 0; i < push.cols(); ++i) {
    Step& step = steps.emplace_back();
    step.delta = delta.col(i);
    substitute(0.0, reduced, false, step);
  }
  return steps;
}

std::optional<Eigen::MatrixXd> NormalEquations::covariance(int n) const {
  // Cholesky of a singular matrix leaves pivots of the size of its rounding, 1e-16 times some thousand.
  constexpr double kMostInflation = 1e13;
  const Reduced reduced = reduce(0.0);
  if (!reduced.positive) return std::nullopt;
  Eigen::MatrixXd covariance = reduced.H.tail_of_inverse(n);
  const double inflation = n == 0 ? 0.0 : covariance.diagonal().cwiseProduct(diagonal().tail(n)).maxCoeff();
  if (!covariance.allFinite() || inflation > kMostInflation) return std::nullopt;
  return covariance;
}

std::optional<Eigen::MatrixXd> NormalEquations::damped_covariance(int n, double lambda) const {
  const Reduced reduced = reduce(lambda);
  if (!reduced.positive) return std::nullopt;
  Eigen::MatrixXd covariance = reduced.H.tail_of_inverse(n);
  if (!covariance.allFinite()) return std::nullopt;
  return covariance;
}

std::optional<NormalEquations::Tail> NormalEquations::tail(int n, double lambda) const {
  const Reduced reduced = reduce(lambda);
  if (!reduced.positive) return std::nullopt;
  Tail tail{reduced.H.tail_information(n), {}};
  tail.gradient = tail.information * reduced.H.solve(reduced.g).bottomRows(n);
  if (!tail.gradient.allFinite()) return std::nullopt;
  return tail;
}

}  // namespace vispline
