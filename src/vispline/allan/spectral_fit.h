/// Maximum likelihood of noise powers over spectral cells. docs/math/allan.md (20)-(22).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "vispline/allan/result.h"
#include "vispline/allan/spectrum.h"

namespace vispline {

/// Which terms may differ from zero, in the order of Term.
using TermMask = std::array<bool, kTerms>;

/// Coefficients of the model: Q^2, N^2, B^2, K^2 (not negative) and R (any sign).
struct SpectralModel {
  TermPowers power{};
  double ramp = 0.0;
};

struct FittedModel {
  SpectralModel model;
  double log_likelihood = 0.0;  ///< up to a constant of the cells
};

/// The cells with a weight each, at most 1: how much of the count is believed.
class SpectralFit {
 public:
  /// Keeps a reference to the cells.
  explicit SpectralFit(std::span<const SpectralCell> cells);

  std::vector<double>& weights() { return weights_; }
  std::span<const SpectralCell> cells() const { return cells_; }

  /// Best model with the terms of `mask`; `held` pins one coefficient (a power, or the ramp) to a value.
  struct Held {
    Term term;
    double value;
  };
  FittedModel maximise(const TermMask& mask, std::optional<Held> held = std::nullopt,
                       const SpectralModel* start = nullptr) const;
  /// Variance of the logarithm of the model's power, averaged over some cells, by the Fisher information of all cells
  /// about the powers that are not zero.
  double log_power_variance(std::span<const std::size_t> of_cells, const SpectralModel& model) const;
  /// Third standardised moment of the score of one power at the model, the other powers of `mask` fitted beside it.
  double score_skewness(Term term, const TermMask& mask, const SpectralModel& model) const;
  /// Expected z^2 of a cell.
  static double variance(const SpectralCell& cell, const SpectralModel& model);
  /// Mean of z^2 with the ramp's mean taken off.
  static double residual_power(const SpectralCell& cell, const SpectralModel& model);

 private:
  using Vector = Eigen::Matrix<double, kVariances, 1>;
  using Matrix = Eigen::Matrix<double, kVariances, kVariances>;

  struct Score {
    Vector gradient;
    Matrix information;
  };
  Score score(const SpectralModel& model) const;
  double log_likelihood(const SpectralModel& model) const;
  double best_ramp(const SpectralModel& model) const;
  SpectralModel first_guess(const TermMask& mask) const;
  /// `start`, or a guess, with what is not in the mask at zero and what is held in its place.
  SpectralModel start_of(const TermMask& mask, const std::optional<Held>& held, const TermMask& free,
                         const SpectralModel* start) const;
  /// Fisher scoring in the free powers; a power at zero stays there while its step points outwards.
  Vector scoring_step(const SpectralModel& model, const TermMask& free) const;
  /// Moves the model by the longest of `move`, half, a quarter, .. that raises the likelihood; returns the likelihood.
  double climb(const Vector& move, SpectralModel& model, double likelihood) const;

  std::span<const SpectralCell> cells_;
  std::vector<double> weights_;
};

}  // namespace vispline
