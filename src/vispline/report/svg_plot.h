/// A plot as SVG: one text for a file of its own and for a page.
#pragma once

#include <string>

#include "vispline/report/plot.h"

namespace vispline::report {

/// A complete <svg> element without script, style or outside reference; the same bytes for the same plot.
/// Write it to a .svg file as it stands. Throws Error for series whose vectors do not fit and for impossible ranges.
std::string render_svg(const Plot& plot);

/// The same with another width than plot.width_px.
std::string render_svg(const Plot& plot, double width_px);

}  // namespace vispline::report
