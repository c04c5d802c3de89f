/// The verb: readings in, in blocks; curves, terms and checks out. docs/math/allan.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vispline/allan/result.h"

namespace vispline {

/// One column of a record.
struct AllanAxis {
  std::string sensor = "series";  ///< "gyroscope", "accelerometer", "series"
  std::string axis = {};
  std::string unit = {};
};

enum class AllanMemory {
  kAuto,     ///< exact up to kExactSamples readings an axis, bounded above
  kExact,    ///< all readings are held
  kBounded,  ///< the log grid only, overlapping Allan only
};

struct AllanOptions {
  std::vector<Deviation> deviations{Deviation::kOadev};
  std::string taus = "log";  ///< grid of averaging_factors()
  AllanMemory memory = AllanMemory::kAuto;
  std::size_t threads = 1;
  bool identify = true;  ///< terms, imu_utils numbers
  bool clock = false;    ///< intervals by the noise type found at each tau instead of by the terms
};

/// Readings an axis up to which kAuto holds them all.
inline constexpr std::int64_t kExactSamples = 4'000'000;
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
