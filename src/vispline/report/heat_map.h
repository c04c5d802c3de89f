/// A matrix as coloured cells in one SVG: correlations, or residuals by region of the image.
#pragma once

#include <string>
#include <vector>

namespace vispline::report {

struct HeatMap {
  std::string title{};
  std::vector<std::string> row_labels{};  ///< at the left, one a row; none: no labels
  std::vector<std::vector<double>>
      values{};       ///< rows from the top, all as long; a value that is not finite is left out
  double low = -1.0;  ///< full colour; with low < 0 < high zero is white, else low is
  double high = 1.0;
  std::string unit{};  ///< of the scale, may be empty
  std::string caption{};
};

/// A complete <svg> element; every cell tells its value when pointed at. The same bytes for the same values. Throws
/// Error for rows of different lengths, labels that do not fit and a scale without extent.
std::string render_svg(const HeatMap& map);

}  // namespace vispline::report
