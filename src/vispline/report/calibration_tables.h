/// Tables of a calibration.
#pragma once

#include "vispline/report/html_page.h"
#include "vispline/results/calibration_result.h"

namespace vispline::report {

/// Start, value, sigma and, where it is known, truth and error in sigmas. Numbers that are not observable have no
/// value.
Table parameter_table(const CalibrationResult& result);
Table residual_table(const CalibrationResult& result);
Table held_table(const CalibrationResult& result);
Table stage_table(const CalibrationResult& result);
Table weak_table(const CalibrationResult& result);
/// Sigmas beside those of jack-knife and twin. Precondition: one of them is there.
Table spread_table(const CalibrationResult& result);

}  // namespace vispline::report
