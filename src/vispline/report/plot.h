/// What a plot shows. Numbers are in the units that the labels name; nothing is computed from them but pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vispline/report/ticks.h"

namespace vispline::report {

enum class SeriesStyle {
  kLine,
  kPoints,
  kLineAndPoints,
  kBand,  ///< the area between lower and upper over x, as of a confidence interval
};

/// The colour of reference lines, as slopes and limits: a quiet grey.
inline constexpr int kGuideColour = -1;

/// Values that are not finite, and on a logarithmic axis those that are not positive, leave a gap.
/// Beyond 1e300 a value counts as not finite.
struct Series {
  std::string name{};  ///< in the legend; an empty name has no entry there
  std::vector<double> x{};
  std::vector<double> y{};      ///< as many as x; empty for a band
  std::vector<double> lower{};  ///< a band's edges, as many as x, else empty
  std::vector<double> upper{};
  SeriesStyle style = SeriesStyle::kLine;
  int colour = 0;  ///< index into a palette of eight for colour-blind readers, or kGuideColour
  bool dashed = false;
};

enum class Side { kRoom, kLeft, kRight };  ///< kRoom: where there is more room

/// A short text that ends up beside a point of the plot.
struct Annotation {
  double x = 0.0;
  double y = 0.0;
  std::string text{};
  Side side = Side::kRoom;
};

struct Plot {
  std::string title{};
  std::string x_label{};  ///< with the unit: "time [s]"
  std::string y_label{};
  std::vector<Series> series{};
  std::vector<Annotation> annotations{};
  bool log_x = false;
  bool log_y = false;
  bool equal_aspect = false;       ///< one unit is as long on x as on y; both axes linear
  std::optional<Range> x_range{};  ///< otherwise what the data need
  std::optional<Range> y_range{};
  double width_px = 760.0;   ///< of the whole drawing, at least 200
  double height_px = 300.0;  ///< of the box between the axes, at least 60; title, legend and labels come on top
};

}  // namespace vispline::report
