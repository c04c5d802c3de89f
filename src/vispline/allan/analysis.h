/// The verb: readings in, in blocks; curves, terms and checks out. docs/math/allan.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vispline/allan/options.h"
#include "vispline/allan/result.h"

namespace vispline {

inline constexpr std::int64_t kFewestSamples = 128;

/// Push the readings block by block, cut() at gaps, then finish() once. The same bytes for any number of threads and
/// any size of blocks.
class AllanAnalyzer {
 public:
  AllanAnalyzer(std::vector<AllanAxis> axes, AllanOptions options);
  ~AllanAnalyzer();
  AllanAnalyzer(const AllanAnalyzer&) = delete;
  AllanAnalyzer& operator=(const AllanAnalyzer&) = delete;

  /// The next readings of every axis, in the order of the axes, all of one length, finite.
  void push(std::span<const std::span<const double>> axes);
  /// A gap: differences never reach across it.
  void cut();
  /// `rate_hz` of the readings within segments. Throws E-TOO-SHORT (exit 4) if no segment has two readings or there are
  /// fewer than `fewest` in all; E-CONSTANT (exit 4) if no axis changes; E-ARGUMENT if the options ask for what bounded
  /// memory cannot give.
  AllanResult finish(double rate_hz, std::int64_t fewest = kFewestSamples);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vispline
