/// The results of this folder as JSON documents and as tables for people. Keys and units: docs/json.md.
#pragma once

#include <string>
#include <vector>

#include "vispline/results/dead_reckoning_error.h"
#include "vispline/results/imu_comparison.h"
#include "vispline/results/json.h"
#include "vispline/results/trajectory_metrics.h"

namespace vispline {

std::string integrate_json(const std::vector<IntegrationRow>& rows, const JsonContext& context);
std::string evaluate_imu_json(const ImuComparison& comparison, const JsonContext& context);
std::string evaluate_trajectory_json(const TrajectoryComparison& comparison, const JsonContext& context);

/// Tables and a few lines around them; diagnostics are not in it.
std::string integrate_text(const std::vector<IntegrationRow>& rows);
std::string evaluate_imu_text(const ImuComparison& comparison);
std::string evaluate_trajectory_text(const TrajectoryComparison& comparison);

}  // namespace vispline
