/// An Allan analysis as a report: numbers in short, curves, terms, what to paste, checks, imu_utils.
#pragma once

#include <string>
#include <vector>

#include "vispline/allan/result.h"
#include "vispline/report/html_page.h"

namespace vispline::report {

/// In short; one section per sensor; numbers to copy; checks; imu_utils if there is something to compare.
std::vector<Section> allan_sections(const AllanResult& result);

/// The whole file. The same bytes for the same result.
std::string allan_page(const AllanResult& result, const std::string& title, const Provenance& provenance = {});

}  // namespace vispline::report
