#include "vispline/allan/result.h"

#include <cmath>
#include <numbers>

namespace vispline {

std::string_view name_of(Term term) {
  constexpr std::array<std::string_view, kTerms> kNames{"quantization", "white", "flicker", "random_walk", "ramp"};
  return kNames[static_cast<std::size_t>(term)];
}

std::string_view symbol_of(Term term) {
  constexpr std::array<std::string_view, kTerms> kSymbols{"Q", "N", "B", "K", "R"};
  return kSymbols[static_cast<std::size_t>(term)];
}

std::string unit_of(Term term, std::string_view unit) {
  const std::string base(unit.empty() ? "1" : unit);
  const bool rate = base == "rad/s";
  switch (term) {
    case Term::kQuantization:
      return rate ? "rad" : base == "m/s^2" ? "m/s" : base + "*s";
    case Term::kWhite:
      return base + "/sqrt(Hz)";
    case Term::kFlicker:
      return std::string(unit);
    case Term::kRandomWalk:
      return (rate ? "rad/s^2" : base == "m/s^2" ? "m/s^3" : base + "/s") + "/sqrt(Hz)";
    case Term::kRamp:
      return rate ? "rad/s^2" : base == "m/s^2" ? "m/s^3" : base + "/s";
  }
  return "";
}

double deviation_of(Term term, double coefficient, double tau_s) {
  switch (term) {
    case Term::kQuantization:
      return std::sqrt(3.0) * coefficient / tau_s;
    case Term::kWhite:
      return coefficient / std::sqrt(tau_s);
    case Term::kFlicker:
      return coefficient * std::sqrt(2.0 * std::numbers::ln2 / std::numbers::pi);
    case Term::kRandomWalk:
      return coefficient * std::sqrt(tau_s / 3.0);
    case Term::kRamp:
      return std::abs(coefficient) * tau_s / std::numbers::sqrt2;
  }
  return 0.0;
}

double NoiseTerms::deviation(double tau_s) const {
  double variance = 0.0;
  for (std::size_t i = 0; i < kTerms; ++i) {
    const double one = deviation_of(static_cast<Term>(i), term[i].value, tau_s);
    variance += one * one;
  }
  return std::sqrt(variance);
}

std::optional<double> NoiseTerms::tau_star_s() const {
  const TermEstimate& white = (*this)[Term::kWhite];
  const TermEstimate& walk = (*this)[Term::kRandomWalk];
  if (!white.resolved || !walk.resolved) return std::nullopt;
  return std::sqrt(3.0) * white.value / walk.value;
}

}  // namespace vispline
