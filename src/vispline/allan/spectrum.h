/// The spectrum of the differences of a series, built while it streams by, in bounded memory. docs/math/allan.md (14).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vispline/allan/term_spectrum.h"

namespace vispline {

/// Transform values of nearly one frequency, pooled.
struct SpectralCell {
  double frequency_hz = 0.0;
  double count = 0.0;     ///< values pooled
  double power = 0.0;     ///< mean of z^2
  double value = 0.0;     ///< z itself if count is 1
  double ramp = 0.0;      ///< E[z] for a ramp of 1 unit/s; 0 where it does not matter
  TermPowers expected{};  ///< E[z^2] of each term with coefficient 1
};

/// The sine transform z_1 .. z_(n-1) of the differences of a series of n >= 2 values.
std::vector<double> difference_transform(std::span<const double> series);

/// Longest n' <= n whose only prime factors are 2, 3 and 5, so that its transform is fast.
std::int64_t smooth_length(std::int64_t n);

/// One axis. Long records become means of 8, 64, .. readings: each level keeps the band of frequencies it resolves
/// best, the last one down to one half wave per record. Memory: kKept values a level.
class SpectrumBuilder {
 public:
  SpectrumBuilder();
  ~SpectrumBuilder();
  SpectrumBuilder(SpectrumBuilder&&) noexcept;
  SpectrumBuilder& operator=(SpectrumBuilder&&) noexcept;

  /// The next readings of the current segment.
  void push(std::span<const double> readings);
  /// A gap: what follows is a segment of its own. Segments below kShortestSegment readings are left out.
  void end_segment();
  /// Of all ended segments, in order of level and frequency, for readings taken at this rate.
  std::vector<SpectralCell> cells(double rate_hz) const;

  static constexpr std::int64_t kShortestSegment = 64;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Cells of a record of this rate and length without power: what a longer record would show.
std::vector<SpectralCell> empty_cells(double rate_hz, double duration_s);

}  // namespace vispline
