/// Plots of a calibration.
#pragma once

#include <optional>

#include "vispline/report/calibration_section.h"

namespace vispline::report {

/// Correlations of all estimated numbers.
HeatMap correlation_map(const CalibrationResult& result);

/// Residuals of a sensor over time with one and three sigma.
Plot residual_plot(const SensorResiduals& residuals);

/// Where the pixels of a camera missed: u against v, with circles of one and three sigma.
Plot reprojection_plot(const SensorResiduals& residuals);
/// Mean residual of each region of the image as an arrow, enlarged; empty without pixels.
Plot region_plot(const SensorResiduals& residuals);

/// From above, and position over time, with the truth where there is one.
std::vector<Plot> course_plots(const CalibrationCourse& course);
/// Distance from the truth over time; empty without truth.
std::optional<Plot> course_error_plot(const CalibrationCourse& course);

}  // namespace vispline::report
