/// Numbers of an Allan analysis as tables of a page, and as text to copy.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "vispline/allan/result.h"
#include "vispline/report/html_page.h"
#include "vispline/results/allan_summary.h"

namespace vispline::report {

/// "white noise density N".
std::string words_of(Term term);
/// Up to six digits without trailing zeros.
std::string plain_number(double value);

/// Coefficients with intervals or bounds: a row per term, a column per axis.
Table terms_table(const AllanResult& result, const SensorSummary& sensor);
/// N and K over the axes: mean, worst, bound of the others, discrete sigma.
Table quantities_table(const AllanResult& result, const SensorSummary& sensor);
/// What imu_utils prints beside what N and K say it should; no row for a sensor without its numbers.
Table imu_utils_table(const std::vector<SensorSummary>& sensors, double rate_hz);
/// A line per signal, cells separated by tabs; what was not found is an empty cell.
std::string tsv_text(const AllanResult& result);

}  // namespace vispline::report
