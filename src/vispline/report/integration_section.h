/// The integration table as a section of a report.
#pragma once

#include <string>
#include <vector>

#include "vispline/report/html_page.h"
#include "vispline/results/dead_reckoning_error.h"

namespace vispline::report {

/// Table of all rows, and the largest error against the rate for every method, both axes logarithmic.
Section integration_section(const std::string& heading, const std::string& text,
                            const std::vector<IntegrationRow>& rows);

}  // namespace vispline::report
