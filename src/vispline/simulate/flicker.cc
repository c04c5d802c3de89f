#include "vispline/simulate/flicker.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace vispline {

const std::array<double, FlickerProcess::kTerms>& FlickerProcess::time_constants() {
  static constexpr std::array<double, kTerms> kTimeConstants{0.1, 1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
  return kTimeConstants;
}

double FlickerProcess::unit_sigma() { return std::sqrt(std::numbers::ln10 / std::numbers::pi); }

FlickerProcess::FlickerProcess(double bias_instability, std::uint64_t seed, const std::string& stream_name)
    : sigma_(bias_instability * unit_sigma()), stream_(seed, stream_name) {
  if (sigma_ == 0.0) return;
  state_ = normals(0);
  for (double& x : state_) x *= sigma_;
}

double FlickerProcess::value() const { return std::accumulate(state_.begin(), state_.end(), 0.0); }

void FlickerProcess::advance(std::uint64_t index, double dt) {
  if (sigma_ == 0.0) return;
  set_step(dt);
  const std::array<double, kTerms> w = normals(index + 1);
  for (std::size_t k = 0; k < kTerms; ++k) state_[k] = decay_[k] * state_[k] + drive_[k] * w[k];
}

void FlickerProcess::set_step(double dt) {
  if (dt == dt_) return;
  dt_ = dt;
  for (std::size_t k = 0; k < kTerms; ++k) {
    const double x = dt / time_constants()[k];
    decay_[k] = std::exp(-x);
    drive_[k] = sigma_ * std::sqrt(-std::expm1(-2.0 * x));
  }
}

std::array<double, FlickerProcess::kTerms> FlickerProcess::normals(std::uint64_t draw) const {
  std::array<double, kTerms> w;
  for (std::size_t pair = 0; pair < kTerms / 2; ++pair) {
    const auto [a, b] = stream_.normal_pair(draw * (kTerms / 2) + pair);
    w[2 * pair] = a;
    w[2 * pair + 1] = b;
  }
  return w;
}

}  // namespace vispline
