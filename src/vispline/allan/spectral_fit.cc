#include "vispline/allan/spectral_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vispline {
namespace {

constexpr int kMaxSteps = 60, kMaxHalvings = 40;
constexpr double kTolerance = 1e-4;  ///< of the log-likelihood; intervals look at differences of 0.5 and more
constexpr std::size_t kRamp = static_cast<std::size_t>(Term::kRamp);

}  // namespace

SpectralFit::SpectralFit(std::span<const SpectralCell> cells) : cells_(cells), weights_(cells.size(), 1.0) {}

double SpectralFit::variance(const SpectralCell& cell, const SpectralModel& model) {
  double v = 0.0;
  for (std::size_t i = 0; i < kVariances; ++i) v += model.power[i] * cell.expected[i];
  return v;
}

double SpectralFit::residual_power(const SpectralCell& cell, const SpectralModel& model) {
  if (cell.ramp == 0.0 || model.ramp == 0.0) return cell.power;
  const double rest = cell.value - model.ramp * cell.ramp;
  return rest * rest;
}

double SpectralFit::log_likelihood(const SpectralModel& model) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double v = variance(cells_[c], model);
    if (!(v > 0.0)) return -std::numeric_limits<double>::infinity();
    sum -= 0.5 * weights_[c] * cells_[c].count * (std::log(v) + residual_power(cells_[c], model) / v);
  }
  return sum;
}

SpectralFit::Score SpectralFit::score(const SpectralModel& model) const {
  Score sum{Vector::Zero(), Matrix::Zero()};
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double v = variance(cells_[c], model);
    const double n = 0.5 * weights_[c] * cells_[c].count;
    const double excess = residual_power(cells_[c], model) / v - 1.0;
    const Vector shape = Eigen::Map<const Vector>(cells_[c].expected.data()) / v;
    sum.gradient += n * excess * shape;
    sum.information += n * shape * shape.transpose();
  }
  return sum;
}

double SpectralFit::log_power_variance(std::span<const std::size_t> of_cells, const SpectralModel& model) const {
  Vector shape = Vector::Zero();
  double count = 0.0;
  for (const std::size_t c : of_cells) {
    shape += cells_[c].count / variance(cells_[c], model) * Eigen::Map<const Vector>(cells_[c].expected.data());
    count += cells_[c].count;
  }
  shape /= count;
  Matrix information = score(model).information;
  for (Eigen::Index i = 0; i < information.rows(); ++i) {
    if (model.power[static_cast<std::size_t>(i)] > 0.0) continue;
    information.row(i).setZero();
    information.col(i).setZero();
    information(i, i) = 1.0;
    shape(i) = 0.0;
  }
  const Vector scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Vector along = scale.cwiseProduct(shape);
  return along.dot(scaled.ldlt().solve(along));
}

double SpectralFit::score_skewness(Term term, const TermMask& mask, const SpectralModel& model) const {
  const auto own = static_cast<Eigen::Index>(term);
  if (own >= static_cast<Eigen::Index>(kVariances)) return 0.0;
  Matrix others = score(model).information;
  Vector shared = others.col(own);
  for (Eigen::Index i = 0; i < others.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i != own && mask[k] && model.power[k] > 0.0) continue;
    others.row(i).setZero();
    others.col(i).setZero();
    others(i, i) = 1.0;
    shared(i) = 0.0;
  }
  const Vector scale = others.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * others * scale.asDiagonal();
  Vector direction = -scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(shared)));
  direction(own) = 1.0;
  double second = 0.0, third = 0.0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double n = weights_[c] * cells_[c].count;
    const double s = direction.dot(Eigen::Map<const Vector>(cells_[c].expected.data())) / variance(cells_[c], model);
    second += 0.5 * n * s * s;
    third += n * s * s * s;
  }
  return second > 0.0 ? third / (second * std::sqrt(second)) : 0.0;
}

double SpectralFit::best_ramp(const SpectralModel& model) const {
  double numerator = 0.0, denominator = 0.0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (cells_[c].ramp == 0.0) continue;
    const double information = weights_[c] * cells_[c].ramp / variance(cells_[c], model);
    numerator += information * cells_[c].value;
    denominator += information * cells_[c].ramp;
  }
  return denominator > 0.0 ? numerator / denominator : 0.0;
}

/// Every free term alone would explain an equal share of each cell, on average over the cells.
SpectralModel SpectralFit::first_guess(const TermMask& mask) const {
  SpectralModel model;
  for (std::size_t i = 0; i < kVariances; ++i) {
    if (!mask[i]) continue;
    double log_smallest = std::numeric_limits<double>::infinity();
    for (const SpectralCell& cell : cells_) {
      if (cell.count >= 8.0 && cell.power > 0.0) {
        log_smallest = std::min(log_smallest, std::log(cell.power / cell.expected[i]));
      }
    }
    model.power[i] = std::isfinite(log_smallest) ? 0.5 * std::exp(log_smallest) : 1.0;
  }
  return model;
}

SpectralFit::Vector SpectralFit::scoring_step(const SpectralModel& model, const TermMask& free) const {
  const auto [gradient, information] = score(model);
  const Vector scale = information.diagonal().cwiseSqrt();
  std::array<bool, kVariances> moves{};
  for (std::size_t i = 0; i < kVariances; ++i) {
    moves[i] = free[i] && (model.power[i] > 0.0 || gradient(static_cast<Eigen::Index>(i)) > 0.0);
  }
  for (bool blocked = true; blocked;) {
    Matrix system = Matrix::Identity();
    Vector move = Vector::Zero();
    for (Eigen::Index i = 0; i < move.size(); ++i) {
      if (!moves[static_cast<std::size_t>(i)]) continue;
      move(i) = gradient(i) / scale(i);
      for (Eigen::Index k = 0; k < move.size(); ++k) {
        const bool both = moves[static_cast<std::size_t>(k)] && k != i;
        if (both) system(i, k) = information(i, k) / std::sqrt(information(i, i) * information(k, k));
      }
    }
    move = system.ldlt().solve(move).eval();
    blocked = false;
    for (Eigen::Index i = 0; i < move.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      move(i) = moves[k] ? move(i) / scale(i) : 0.0;
      if (!moves[k] || model.power[k] > 0.0 || move(i) >= 0.0) continue;
      moves[k] = false;
      blocked = true;
    }
    if (!blocked) return move;
  }
  return Vector::Zero();
}

double SpectralFit::climb(const Vector& move, SpectralModel& model, double likelihood) const {
  double length = 1.0;
  for (int halving = 0; halving < kMaxHalvings; ++halving, length *= 0.5) {
    SpectralModel next = model;
    for (std::size_t i = 0; i < kVariances; ++i) {
      const double step = length * move(static_cast<Eigen::Index>(i));
      if (step != 0.0) next.power[i] = std::max(0.0, model.power[i] + step);
    }
    const double higher = log_likelihood(next);
    if (!(higher > likelihood)) continue;
    model = next;
    return higher;
  }
  return likelihood;
}

SpectralModel SpectralFit::start_of(const TermMask& mask, const std::optional<Held>& held, const TermMask& free,
                                    const SpectralModel* start) const {
  SpectralModel model = start ? *start : first_guess(mask);
  for (std::size_t i = 0; i < kVariances; ++i) {
    if (!mask[i]) model.power[i] = 0.0;
  }
  if (!mask[kRamp]) model.ramp = 0.0;
  if (held) {
    const auto i = static_cast<std::size_t>(held->term);
    (i == kRamp ? model.ramp : model.power[i]) = held->value;
  }
  if (std::isfinite(log_likelihood(model))) return model;
  const SpectralModel guess = first_guess(mask);
  for (std::size_t i = 0; i < kVariances; ++i) {
    if (free[i]) model.power[i] = guess.power[i];
  }
  return model;
}

FittedModel SpectralFit::maximise(const TermMask& mask, std::optional<Held> held, const SpectralModel* start) const {
  TermMask free = mask;
  if (held) free[static_cast<std::size_t>(held->term)] = false;
  SpectralModel model = start_of(mask, held, free, start);
  double best = log_likelihood(model);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double before = best;
    if (free[kRamp]) {
      model.ramp = best_ramp(model);
      best = log_likelihood(model);
    }
    best = climb(scoring_step(model, free), model, best);
    if (best - before <= kTolerance) break;
  }
  return {model, best};
}

}  // namespace vispline
