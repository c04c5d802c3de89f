/// What `vispline allan --out DIR` leaves behind.
#pragma once

#include <string>
#include <vector>

#include "console.h"
#include "vispline/allan/result.h"
#include "vispline/calibration/noise_entry.h"

namespace vispline::cli {

/// The worst axis of each triad: N, and K where any axis resolves it, else its largest bound. Throws E-UNRESOLVED (exit
/// 4) if a triad is missing or none of its axes shows white noise.
ImuNoiseEntry noise_entry(const AllanResult& result, const std::string& topic);

/// allan.json, curve.csv, report.html, and for each dialect its file(s), in `dir`. Returns what to do next, a line
/// each.
std::vector<std::string> write_allan(const std::string& dir, const AllanResult& result,
                                     const std::vector<std::string>& dialects, const std::string& topic,
                                     const std::string& title, const Session& session);

/// Throws E-ARGUMENT for a dialect that is not known.
void check_dialects(const std::vector<std::string>& dialects);

}  // namespace vispline::cli
