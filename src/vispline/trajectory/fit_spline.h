/// Least-squares fit of a spline on any group to noisy elements at any stamps. Gauss-Newton on the knots with banded
/// normal equations: memory and time are linear in the length of the data. docs/math/fit.md, equations (1)-(6).
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "vispline/core/signal.h"
#include "vispline/trajectory/banded_cholesky.h"
#include "vispline/trajectory/spline.h"

namespace vispline {

template <class G>
struct SplineFitOptions {
  using Tangent = typename G::template Tangent<double>;
  Duration spacing{};
  Tangent sigma = Tangent::Ones();                ///< standard deviation of a measurement, per tangent axis
  Tangent jerk_density = Tangent::Constant(1e3);  ///< prior: white third difference, unit/s^3/sqrt(Hz)
  double huber = 3.0;                             ///< residuals this many times the usual one count linearly
  int max_iterations = 50;
  std::function<void()> poll{};  ///< called every few milliseconds of work; may throw to stop the fit
};

template <class G, int K>
struct SplineFit {
  Spline<G, K> spline;
  std::vector<typename G::template Tangent<double>> residual;  ///< log(measured^-1 fitted), per measurement
  std::vector<double> size;                                    ///< of each residual, as a multiple of the usual one
  int iterations = 0;
  bool converged = false;
};

namespace detail {

/// The Gauss-Newton step of one fit: normal matrix in a band of K knots, gradient.
template <class G, int K>
class SplineNormalEquations {
 public:
  static constexpr int kDof = G::kDof;
  using Block = Eigen::Matrix<double, kDof, kDof>;
  using Tangent = typename G::template Tangent<double>;

  explicit SplineNormalEquations(std::size_t knots)
      : matrix_(size(knots), K * kDof - 1), gradient_(Eigen::VectorXd::Zero(size(knots))) {}

  /// Adds |r + sum_m J_m delta_{first+m}|^2.
  template <std::size_t kBlocks>
  void add(std::size_t first, const std::array<Block, kBlocks>& J, const Tangent& r) {
    for (std::size_t a = 0; a < kBlocks; ++a) {
      const Eigen::Index row = size(first + a);
      gradient_.segment<kDof>(row) += J[a].transpose() * r;
      for (std::size_t b = 0; b <= a; ++b) {
        const Block H = J[a].transpose() * J[b];
        const Eigen::Index col = size(first + b);
        for (int j = 0; j < kDof; ++j) {
          for (int i = a == b ? j : 0; i < kDof; ++i) matrix_(row + i, col + j) += H(i, j);
        }
      }
    }
  }

  /// Holds directions that neither a measurement nor the prior sees where they are.
  void damp(const Tangent& weight) {
    for (Eigen::Index i = 0; i < gradient_.size(); ++i) matrix_(i, i) += weight(i % kDof);
  }

  std::vector<Tangent> solve() {
    if (!matrix_.factorize()) {
      throw Error(ExitCode::kUntrusted, {.code = "E-FIT-SINGULAR",
                                         .message = "the normal equations of the spline fit are not positive definite",
                                         .where = "",
                                         .effect = "no curve fitted",
                                         .next = "choose a larger knot spacing or check the stamps of the poses"});
    }
    const Eigen::VectorXd x = matrix_.solve(-gradient_);
    std::vector<Tangent> delta(static_cast<std::size_t>(x.size() / kDof));
    for (std::size_t k = 0; k < delta.size(); ++k) delta[k] = x.segment<kDof>(size(k));
    return delta;
  }

 private:
  static Eigen::Index size(std::size_t knots) { return static_cast<Eigen::Index>(knots) * kDof; }
  BandedCholesky matrix_;
  Eigen::VectorXd gradient_;
};

/// Measured elements interpolated at the times of the knots: the start of the iteration.
template <class G>
std::vector<typename G::template Element<double>> initial_knots(
    const Signal<typename G::template Element<double>>& measured, Time first, Duration spacing, std::size_t knots) {
  std::vector<typename G::template Element<double>> result;
  std::size_t i = 0;
  for (std::size_t k = 0; k < knots; ++k) {
    const Time t = first + spacing * static_cast<std::int64_t>(k);
    while (i + 2 < measured.size() && measured.time[i + 1] < t) ++i;
    const auto& X = measured.value[i];
    if (measured.size() == 1) {
      result.push_back(X);
      continue;
    }
    const double u = to_seconds(t - measured.time[i]) / to_seconds(measured.time[i + 1] - measured.time[i]);
    const auto d =
        G::template log<double>(G::template compose<double>(G::template inverse<double>(X), measured.value[i + 1]));
    const double clamped = std::clamp(u, 0.0, 1.0);
    result.push_back(G::template compose<double>(X, G::template exp<double>(clamped * d)));
  }
  return result;
}

}  // namespace detail

template <class G, int K>
class SplineFitter {
 public:
  using Element = typename G::template Element<double>;
  using Tangent = typename G::template Tangent<double>;

  SplineFitter(const Signal<Element>& measured, const SplineFitOptions<G>& options)
      : measured_(measured), options_(options), inverse_sigma_(options.sigma.cwiseInverse()) {
    require(!measured.empty(), "at least one measurement to fit a spline to");
  }

  SplineFit<G, K> run() const {
    SplineFit<G, K> fit{start(), {}, {}, 0, false};
    while (!fit.converged && fit.iterations < options_.max_iterations) {
      ++fit.iterations;
      const double scale = residual_scale(fit.spline);
      const std::vector<Tangent> delta = step(fit.spline, options_.huber * scale);
      fit.spline.retract(delta);
      double largest = 0.0;
      for (const Tangent& d : delta) largest = std::max(largest, d.cwiseProduct(inverse_sigma_).cwiseAbs().maxCoeff());
      fit.converged = largest < 1e-2 * scale;
    }
    const double scale = residual_scale(fit.spline);
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      fit.residual.push_back(residual(fit.spline.element(measured_.time[i]), i));
      fit.size.push_back(whitened_norm(fit.residual.back()) / scale);
    }
    return fit;
  }

 private:
  using Equations = detail::SplineNormalEquations<G, K>;
  using Block = typename Equations::Block;

  Spline<G, K> start() const {
    const Time begin = measured_.time.front();
    const Duration spacing = options_.spacing;
    const std::size_t knots = Spline<G, K>::knots_for(std::max(measured_.span().end - begin, Duration(1)), spacing);
    return Spline<G, K>(begin, spacing,
                        detail::initial_knots<G>(measured_, begin - spacing * (K - 2) / 2, spacing, knots));
  }

  Tangent residual(const Element& X, std::size_t i) const {
    return G::template log<double>(G::template compose<double>(G::template inverse<double>(measured_.value[i]), X));
  }

  /// Norm of a residual in sigma per axis.
  double whitened_norm(const Tangent& r) const {
    return r.cwiseProduct(inverse_sigma_).norm() / std::sqrt(static_cast<double>(G::kDof));
  }

  /// Median residual in sigma, at least 1: where the knots are too far apart for the noise, most residuals are larger
  /// and none of them is an outlier for it.
  double residual_scale(const Spline<G, K>& spline) const {
    std::vector<double> norms;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      norms.push_back(whitened_norm(residual(spline.element(measured_.time[i]), i)));
    }
    const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2);
    std::nth_element(norms.begin(), middle, norms.end());
    return std::max(1.0, *middle);
  }

  std::vector<Tangent> step(const Spline<G, K>& spline, double huber) const {
    Equations equations(spline.knots().size());
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      if (options_.poll && i % 4096 == 0) options_.poll();
      add_measurement(spline, i, huber, equations);
    }
    for (std::size_t k = 0; k + 3 < spline.knots().size(); ++k) add_prior(spline, k, equations);
    equations.damp(1e-6 * prior_weight(spline).cwiseAbs2());
    return equations.solve();
  }

  void add_measurement(const Spline<G, K>& spline, std::size_t i, double huber, Equations& equations) const {
    const auto place = spline.locate(measured_.time[i]);
    const auto basis = spline.basis(place);
    const auto point = spline.template point<0>(place, basis);
    const Tangent r = residual(point.X, i);
    const Tangent whitened = r.cwiseProduct(inverse_sigma_);
    const double norm = whitened_norm(r);
    const double weight = norm > huber ? std::sqrt(huber / norm) : 1.0;
    const Block J_r_inv = Block::Identity() * G::template left_jacobian_inverse<double>(-r);
    const Block L = (weight * inverse_sigma_).asDiagonal() * J_r_inv;
    equations.add(place.first, cumulative_pull_back<G, K, G::kDof>(point, &spline.pairs()[place.first], L),
                  weight * whitened);
  }

  /// 1 / (q h^2.5): one over the standard deviation of a third difference of knots.
  Tangent prior_weight(const Spline<G, K>& spline) const {
    return (options_.jerk_density * std::pow(to_seconds(spline.spacing()), 2.5)).cwiseInverse();
  }

  /// Third difference of four consecutive knots, d_{k+2} - 2 d_{k+1} + d_k: zero for a constant twist rate.
  void add_prior(const Spline<G, K>& spline, std::size_t k, Equations& equations) const {
    const auto* pair = &spline.pairs()[k];
    const Block W = prior_weight(spline).asDiagonal();
    const Tangent r = W * (pair[2].d - 2.0 * pair[1].d + pair[0].d);
    const auto after = [&](int i) { return Block(W * pair[i].Jr_inv); };
    const auto before = [&](int i) { return Block(after(i) - G::times_ad(W, pair[i].d)); };
    equations.template add<4>(k, {-before(0), after(0) + 2.0 * before(1), -2.0 * after(1) - before(2), after(2)}, r);
  }

  const Signal<Element>& measured_;
  const SplineFitOptions<G>& options_;
  Tangent inverse_sigma_;
};

}  // namespace vispline
