/// A calibration as a report: class and reasons, parameters, what they hang together with, residuals, motion, weak
/// directions and what to record next.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/report/html_page.h"
#include "vispline/results/calibration_result.h"

namespace vispline::report {

/// The motion of the body; `truth` aligned with it, where somebody knows it.
struct CalibrationCourse {
  Signal<Pose> T_w_b{};
  Signal<Pose> truth_T_w_b{};  ///< empty: unknown
};

std::vector<Section> calibration_sections(const CalibrationResult& result, const CalibrationCourse& course);

/// The whole file. The same bytes for the same result.
std::string calibration_page(const CalibrationResult& result, const CalibrationCourse& course, const std::string& title,
                             const Provenance& provenance = {});

}  // namespace vispline::report
