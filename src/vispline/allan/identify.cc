#include "vispline/allan/identify.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>

#include "vispline/allan/spectral_fit.h"

namespace vispline {
namespace {

constexpr std::size_t kFlicker = static_cast<std::size_t>(Term::kFlicker);
constexpr std::size_t kRamp = static_cast<std::size_t>(Term::kRamp);
constexpr double kFirstCount = 2000.0;   ///< of an octave in the first fit: every octave has a say
constexpr double kBelievedMisfit = 9.0;  ///< chi-square of an octave up to which it keeps its full weight
constexpr double kReportedMisfit = 0.10;
constexpr double kTwoSided68 = 1.0, kTwoSided95 = 3.841;
/// Twice the log-likelihood by which flicker, or a ramp, has to be better than a random walk to be named instead.
constexpr double kFlickerHandicap = 4.0, kRampHandicap = 8.0;
/// Expected loss of twice the log-likelihood at which a term is found nine times out of ten: (sqrt(15.14) + 1.28)^2.
constexpr double kSurelyFound = 26.7;
constexpr double kLongestFactor = 1e4;

int octave_of(const SpectralCell& cell, double rate_hz) {
  return static_cast<int>(std::floor(std::log2(cell.frequency_hz / rate_hz)));
}

struct Octave {
  double count = 0.0, ratio = 0.0;
  std::vector<std::size_t> cells;
};

/// Measured over fitted power of each octave of frequency.
std::map<int, Octave> octaves(const SpectralFit& fit, const SpectralModel& model, double rate_hz) {
  std::map<int, Octave> found;
  for (std::size_t c = 0; c < fit.cells().size(); ++c) {
    const SpectralCell& cell = fit.cells()[c];
    Octave& octave = found[octave_of(cell, rate_hz)];
    octave.cells.push_back(c);
    octave.count += cell.count;
    octave.ratio += cell.count * SpectralFit::residual_power(cell, model) / SpectralFit::variance(cell, model);
  }
  for (auto& entry : found) entry.second.ratio /= entry.second.count;
  return found;
}

/// docs/math/allan.md (22): an octave that the terms miss is believed as far as it agrees with them.
void reweight(SpectralFit& fit, const SpectralModel& model, double rate_hz) {
  std::vector<double> weights(fit.cells().size());
  for (const auto& [number, octave] : octaves(fit, model, rate_hz)) {
    const double variance = 2.0 / octave.count + fit.log_power_variance(octave.cells, model);
    const double chi_square = (octave.ratio - 1.0) * (octave.ratio - 1.0) / variance;
    for (const std::size_t c : octave.cells) {
      weights[c] = std::min(1.0, kBelievedMisfit / std::max(chi_square, 1e-12));
    }
  }
  fit.weights() = std::move(weights);
}

FittedModel robust_fit(SpectralFit& fit, const TermMask& all, double rate_hz) {
  std::map<int, double> counts;
  for (const SpectralCell& cell : fit.cells()) counts[octave_of(cell, rate_hz)] += cell.count;
  for (std::size_t c = 0; c < fit.cells().size(); ++c) {
    fit.weights()[c] = std::min(1.0, kFirstCount / counts[octave_of(fit.cells()[c], rate_hz)]);
  }
  FittedModel fitted = fit.maximise(all);
  for (int pass = 0; pass < 6; ++pass) {
    reweight(fit, fitted.model, rate_hz);
    fitted = fit.maximise(all, std::nullopt, &fitted.model);
  }
  return fitted;
}

/// The terms with the largest likelihood after each has paid its threshold; flicker and a ramp pay more than a walk,
/// which bends a short curve much the same and is what an estimator has to be told. docs/math/allan.md (23)
FittedModel select(const SpectralFit& fit, TermMask& mask, const FittedModel& all) {
  FittedModel best = all;
  double best_score = -HUGE_VAL;
  for (unsigned subset = 1; subset < 1u << kTerms; ++subset) {
    TermMask terms{};
    for (std::size_t i = 0; i < kTerms; ++i) terms[i] = (subset >> i & 1u) != 0;
    if (std::none_of(terms.begin(), terms.begin() + kVariances, [](bool on) { return on; })) continue;
    const FittedModel fitted = fit.maximise(terms);
    const double score = 2.0 * fitted.log_likelihood - kSignificance * static_cast<double>(std::popcount(subset)) -
                         (terms[kFlicker] ? kFlickerHandicap : 0.0) - (terms[kRamp] ? kRampHandicap : 0.0);
    if (!(score > best_score)) continue;
    best_score = score;
    best = fitted;
    mask = terms;
  }
  return best;
}

/// Where twice the log-likelihood has fallen by `loss` from its top, searched from `from` by growing steps towards
/// larger (step > 1) or smaller values of a positive coefficient; 0 if it never falls so far on the way down.
double profile_edge(const std::function<double(double)>& loss_at, double from, double step, double loss) {
  double inside = from, outside = from;
  for (int i = 0; i < 200; ++i) {
    outside = inside * step;
    if (loss_at(outside) >= loss) break;
    inside = outside;
    if (outside < 1e-9 * from) return 0.0;
    if (outside > 1e9 * from) return outside;
    step *= step > 1.0 ? 1.1 : 1.0 / 1.1;
  }
  for (int i = 0; i < 40 && std::abs(outside / inside - 1.0) > 1e-5; ++i) {
    const double middle = std::sqrt(inside * outside);
    (loss_at(middle) < loss ? inside : outside) = middle;
  }
  return std::sqrt(inside * outside);
}

/// Coefficient of a term, not its square.
double coefficient(const SpectralModel& model, std::size_t term) {
  return term == kRamp ? std::abs(model.ramp) : std::sqrt(model.power[term]);
}

/// What the data lose when the coefficient of `term` is c (with the sign of the fitted ramp), as the square of a
/// standard normal number: the signed root of the loss of twice the log-likelihood, with its mean taken off.
/// docs/math/allan.md (24)
std::function<double(double)> profile(const SpectralFit& fit, TermMask mask, std::size_t term,
                                      const FittedModel& best) {
  mask[term] = true;
  return [&fit, mask, term, best](double c) {
    const double held = term == kRamp ? std::copysign(c, best.model.ramp) : c * c;
    const FittedModel at = fit.maximise(mask, SpectralFit::Held{static_cast<Term>(term), held}, &best.model);
    const double root = std::sqrt(std::max(0.0, 2.0 * (best.log_likelihood - at.log_likelihood)));
    const double shift = fit.score_skewness(static_cast<Term>(term), mask, at.model) / 6.0;
    const double above = c > coefficient(best.model, term) ? -1.0 : 1.0;
    const double normal = std::max(0.0, root + above * shift);
    return normal * normal;
  };
}

/// Step of a first look around a coefficient that matters by `significance`.
double first_step(double significance) { return 1.0 + 1.0 / std::sqrt(std::max(significance, 1.0)); }

TermEstimate resolved_term(const SpectralFit& fit, const TermMask& mask, std::size_t term, const FittedModel& best) {
  TermEstimate estimate;
  TermMask less = mask;
  less[term] = false;
  estimate.resolved = true;
  estimate.value = coefficient(best.model, term);
  const FittedModel without = fit.maximise(less, std::nullopt, &best.model);
  estimate.significance = 2.0 * (best.log_likelihood - without.log_likelihood);
  if (!std::isfinite(estimate.significance)) estimate.significance = 1e18;  // nothing else is left to explain the data
  const auto loss = profile(fit, mask, term, best);
  const double step = first_step(std::min(estimate.significance, 1e6));
  estimate.low_68 = profile_edge(loss, estimate.value, 1.0 / step, kTwoSided68);
  estimate.high_68 = profile_edge(loss, estimate.value, step, kTwoSided68);
  estimate.low_95 = profile_edge(loss, estimate.value, 1.0 / step, kTwoSided95);
  estimate.high_95 = profile_edge(loss, estimate.value, step, kTwoSided95);
  if (term == kRamp && best.model.ramp < 0.0) {
    estimate.value = -estimate.value;
    estimate.low_68 = -std::exchange(estimate.high_68, -estimate.low_68);
    estimate.low_95 = -std::exchange(estimate.high_95, -estimate.low_95);
  }
  return estimate;
}

/// A coefficient so small that it cannot matter, from the scale of the data: where the search for a bound begins.
double tiny_coefficient(const SpectralFit& fit, std::size_t term, const SpectralModel& model) {
  double smallest = HUGE_VAL;
  for (const SpectralCell& cell : fit.cells()) {
    const double per_unit = term == kRamp ? cell.ramp * cell.ramp : cell.expected[term];
    if (per_unit > 0.0) smallest = std::min(smallest, SpectralFit::variance(cell, model) / per_unit);
  }
  return std::isfinite(smallest) ? 1e-3 * std::sqrt(smallest) : 0.0;
}

/// What leaving `term` out would cost on average in a record of this length whose noise is `truth`.
double expected_significance(double rate_hz, double duration_s, const TermMask& mask, std::size_t term,
                             const SpectralModel& truth) {
  std::vector<SpectralCell> cells = empty_cells(rate_hz, duration_s);
  for (SpectralCell& cell : cells) {
    cell.power = SpectralFit::variance(cell, truth) + cell.ramp * cell.ramp * truth.ramp * truth.ramp;
    cell.ramp = 0.0;
  }
  const SpectralFit fit(cells);
  TermMask with = mask, without = mask;
  with[term] = true;
  without[term] = false;
  SpectralModel start = truth;
  const double full = fit.maximise(with, std::nullopt, &start).log_likelihood;
  return 2.0 * (full - fit.maximise(without, std::nullopt, &start).log_likelihood);
}

/// Length of a record that would find a coefficient half as large as the bound; none if this record would have, so that
/// only the terms that look like it make the bound so wide.
std::optional<double> record_needed(double rate_hz, double duration_s, const TermMask& mask, std::size_t term,
                                    SpectralModel truth, double bound) {
  if (term == kRamp) return std::nullopt;
  truth.power[term] = 0.25 * bound * bound;
  truth.ramp = 0.0;
  double longer = duration_s;
  while (expected_significance(rate_hz, longer, mask, term, truth) < kSurelyFound) {
    longer *= 1.25;
    if (longer > kLongestFactor * duration_s) return std::nullopt;
  }
  return longer > duration_s ? std::optional(longer) : std::nullopt;
}

/// The terms with `term` in the place of those that look like it in a short record; empty if there are none.
std::optional<TermMask> without_look_alikes(TermMask mask, std::size_t term) {
  bool any = false;
  for (const Term other : {Term::kFlicker, Term::kRandomWalk, Term::kRamp}) {
    const auto i = static_cast<std::size_t>(other);
    any = any || (mask[i] && i != term);
    mask[i] = i == term;
  }
  const bool is_one = term >= kFlicker && term < kRamp;
  return any && is_one ? std::optional(mask) : std::nullopt;
}

TermEstimate bounded_term(const SpectralFit& fit, const TermMask& mask, std::size_t term, const FittedModel& best,
                          double rate_hz, double duration_s) {
  TermEstimate estimate;
  TermMask more = mask;
  more[term] = true;
  const FittedModel with = fit.maximise(more);
  estimate.significance = std::max(0.0, 2.0 * (with.log_likelihood - best.log_likelihood));
  const FittedModel& top = with.log_likelihood > best.log_likelihood ? with : best;
  const double start = std::max(tiny_coefficient(fit, term, best.model), coefficient(top.model, term));
  if (start <= 0.0) return estimate;
  double bound = profile_edge(profile(fit, mask, term, top), start, 1.5, kTwoSided95);
  if (const auto alone = without_look_alikes(mask, term)) {
    const FittedModel other = fit.maximise(*alone);
    const double from = std::max(start, coefficient(other.model, term));
    bound = std::max(bound, profile_edge(profile(fit, *alone, term, other), from, 1.5, kTwoSided95));
  }
  estimate.upper_bound = bound;
  estimate.record_needed_s = record_needed(rate_hz, duration_s, mask, term, best.model, bound);
  return estimate;
}

std::vector<ModelMisfit> misfits(const SpectralFit& fit, const SpectralModel& model, double rate_hz) {
  std::vector<ModelMisfit> list;
  for (const auto& [octave, found] : octaves(fit, model, rate_hz)) {
    const double noise = 4.0 * std::sqrt(2.0 / found.count);
    if (std::abs(found.ratio - 1.0) < std::max(kReportedMisfit, noise)) continue;
    list.push_back({std::exp2(octave) * rate_hz, std::exp2(octave + 1) * rate_hz, found.ratio});
  }
  return list;
}

}  // namespace

Identification identify(std::span<const SpectralCell> all_cells, double rate_hz, double duration_s) {
  std::vector<SpectralCell> cells(all_cells.begin(), all_cells.end());
  double total = 0.0;
  for (const SpectralCell& cell : cells) total += cell.power * cell.count;
  Identification result;
  if (cells.size() < 8 || !(total > 0.0) || !std::isfinite(total)) return result;

  SpectralFit fit(cells);
  TermMask mask{true, true, true, true, true};
  FittedModel fitted = robust_fit(fit, mask, rate_hz);
  fitted = select(fit, mask, fitted);
  for (std::size_t i = 0; i < kTerms; ++i) {
    result.terms.term[i] =
        mask[i] ? resolved_term(fit, mask, i, fitted) : bounded_term(fit, mask, i, fitted, rate_hz, duration_s);
  }
  result.misfits = misfits(fit, fitted.model, rate_hz);
  return result;
}

}  // namespace vispline
