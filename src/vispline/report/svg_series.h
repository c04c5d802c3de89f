/// The curves of a plot as SVG paths, in pixels of the box between the axes.
#pragma once

#include <string>
#include <vector>

#include "vispline/report/axis.h"
#include "vispline/report/decimate.h"
#include "vispline/report/markup.h"

namespace vispline::report {

/// Throws Error unless the vectors of the series fit its style.
void check(const Series& series);

/// Stretches of a curve without gaps, thinned to what can be seen.
std::vector<std::vector<Point>> curves(const Series& series, const Axes& axes);

/// Single points that can be drawn, thinned to one a pixel.
std::vector<Point> markers(const Series& series, const Axes& axes);

/// Closed outlines of a band. A lower edge that a logarithmic axis cannot show lies at the bottom.
std::vector<std::vector<Point>> outlines(const Series& band, const Axes& axes);

/// `#0072B2` and so on; any index, in a circle.
std::string colour_hex(int colour);

/// `c0` ... `c7` or `cg`: the class by which a page restyles the colour.
std::string colour_class(int colour);

/// The mark of a series around a point, to append to the path `d`: shape and colour change together.
std::string marker_path(int colour, Point centre);

/// Draws one series into the open element.
void draw_series(const Series& series, const Axes& axes, Markup& svg);

/// The sample of a series in the legend, 22 px wide, centred on y.
void draw_sample(const Series& series, double x, double y, Markup& svg);

}  // namespace vispline::report
