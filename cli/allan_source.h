/// Files and simulated records into an AllanAnalyzer.
#pragma once

#include <string>

#include "console.h"
#include "vispline/allan/analysis.h"
#include "vispline/core/noise.h"
#include "vispline/io/read_options.h"

namespace vispline::cli {

/// Streams an IMU file through the analysis: all axes the file has, segments cut at gaps, the rate from the stamps.
AllanResult analyze_imu(const std::string& path, const ReadOptions& read, const AllanOptions& options,
                        Session& session);

/// A column of frequencies (readings) or phases (their sums). `rate_hz` of the column; a missing number cuts it.
AllanResult analyze_series(const std::string& path, const ReadOptions& read, bool phase, double rate_hz,
                           const AllanOptions& options, Session& session);

/// A still IMU with this noise, one axis of each triad.
AllanResult analyze_simulated(const ImuNoise& noise, double rate_hz, double duration_s, std::uint64_t seed,
                              const AllanOptions& options);

}  // namespace vispline::cli
