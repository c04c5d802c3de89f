/// What an Allan analysis is asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vispline/allan/deviation.h"

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
  bool clock = false;    ///< intervals by the noise type found at each tau instead of by the terms, if all is held
};

/// Readings an axis up to which kAuto holds them all.
inline constexpr std::int64_t kExactSamples = 4'000'000;

}  // namespace vispline
