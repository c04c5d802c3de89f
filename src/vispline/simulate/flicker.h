/// Bias instability: 1/f noise as a sum of first-order Gauss-Markov processes. docs/math/noise.md (7)-(10).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "vispline/core/random.h"

namespace vispline {

/// One process per decade of time constant, all with the same variance B^2 ln(10) / pi. The Allan deviation of the sum
/// stays within 2.5 % of 0.664 B for averaging times from 1 s to 1e5 s, at rates of 10 Hz and more.
class FlickerProcess {
 public:
  static constexpr std::size_t kTerms = 8;
  /// s; 0.1, 1, ..., 1e6.
  static const std::array<double, kTerms>& time_constants();
  /// Standard deviation of each term, for B = 1.
  static double unit_sigma();

  /// Starts in the stationary distribution. B in the unit of the triad; 0: always 0, and no numbers are drawn.
  FlickerProcess(double bias_instability, std::uint64_t seed, const std::string& stream_name);

  double value() const;
  /// Moves on by dt seconds, from sample `index` to the next one; call it once for every sample, in order.
  void advance(std::uint64_t index, double dt);

 private:
  void set_step(double dt);
  /// kTerms standard normals; draw 0 starts the process, draw index + 1 belongs to sample `index`.
  std::array<double, kTerms> normals(std::uint64_t draw) const;

  double sigma_;
  RandomStream stream_;
  double dt_ = -1.0;
  std::array<double, kTerms> state_{};
  std::array<double, kTerms> decay_{};  ///< exp(-dt/T)
  std::array<double, kTerms> drive_{};  ///< sigma sqrt(1 - exp(-2 dt/T))
};

}  // namespace vispline
