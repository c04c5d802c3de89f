/// Deviations of a series of phases (time, angle, velocity) sampled evenly. docs/math/allan.md (1)-(8).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/allan/cache_aligned.h"

namespace vispline {

enum class Deviation {
  kOadev,   ///< overlapping Allan
  kAdev,    ///< Allan, without overlap
  kMdev,    ///< modified Allan
  kTdev,    ///< time deviation, tau/sqrt(3) times the modified Allan
  kHdev,    ///< Hadamard, without overlap
  kOhdev,   ///< overlapping Hadamard
  kTotdev,  ///< total deviation: the phase reflected at both ends
};

/// "oadev", "adev", "mdev", "tdev", "hdev", "ohdev", "totdev".
std::string_view name_of(Deviation kind);
std::optional<Deviation> deviation_named(std::string_view name);
std::vector<std::string> deviation_names();

/// Sum of squared differences of phases at one averaging factor, and how many. Those of several segments add up.
struct SquaredSum {
  double sum = 0.0;
  std::int64_t count = 0;

  SquaredSum& operator+=(const SquaredSum& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
};

/// Phase points: n readings x_k [unit] at rate_hz -> n + 1 sums of (x - mean) / rate [unit s], starting at 0. The mean
/// is the caller's: a deviation does not depend on it, its rounding does.
Phase phase_of(std::span<const double> readings, double rate_hz, double mean);

/// Squared differences of kind over `phase` at averaging factor m >= 1; count 0 if the phase is too short.
SquaredSum squared_sum(Deviation kind, std::span<const double> phase, std::int64_t m);

/// The deviation [unit] of a pooled sum; nan if its count is 0.
double deviation(Deviation kind, const SquaredSum& pooled, std::int64_t m, double rate_hz);

/// Fewest phase points for averaging factor m.
std::int64_t points_needed(Deviation kind, std::int64_t m);

}  // namespace vispline
