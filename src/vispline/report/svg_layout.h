/// Where the parts of a plot go: legend above the box, labels around it, nothing over the data.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vispline/report/axis.h"

namespace vispline::report {

inline constexpr double kFontPx = 12.0;
inline constexpr double kTitlePx = 15.0;
inline constexpr double kSamplePx = 28.0;  ///< a sample of the legend and its gap

/// A series named in the legend; x, y of the sample's left end, below the title.
struct LegendItem {
  const Series* series;
  std::string text;
  double x;
  double y;
};

struct Legend {
  std::vector<LegendItem> items;
  double height_px = 0.0;
};

/// The box between the axes inside the drawing, and the drawing's size.
struct Layout {
  double left;
  double top;
  double width;
  double height;
  double total_width;
  double total_height;
  double legend_top;
};

/// Rows from left to right, as running text breaks; names are shortened to the width of the drawing.
Legend make_legend(const Plot& plot, double width_px);

Layout make_layout(const Plot& plot, const Legend& legend, double width_px);

/// As many ticks as fit when labels stand about `spacing_px` apart.
Ticks ticks_of(const Axis& axis, double spacing_px);
inline constexpr double kXSpacingPx = 85.0;
inline constexpr double kYSpacingPx = 48.0;

double widest_px(const Ticks& ticks);

/// Write every n-th label, so that neighbours that need `label_px` along the axis do not touch.
std::size_t label_stride(const Ticks& ticks, const Axis& axis, double label_px);

}  // namespace vispline::report
