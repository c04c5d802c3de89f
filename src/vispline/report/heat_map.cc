#include "vispline/report/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/report/escape.h"
#include "vispline/report/markup.h"

namespace vispline::report {
namespace {

constexpr std::string_view kFont = "system-ui, -apple-system, Segoe UI, Roboto, Helvetica Neue, Arial, sans-serif";
constexpr double kWidthPx = 760.0, kTopPx = 52.0, kLabelEm = 0.56, kMostLabelPx = 260.0;
constexpr double kLeastCellPx = 5.0, kMostCellPx = 26.0, kScalePx = 180.0;
constexpr std::array<double, 3> kWhite{250, 250, 250}, kBlue{0, 90, 160}, kOrange{200, 80, 0};

std::string hex(const std::array<double, 3>& rgb) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const double channel : rgb) {
    const auto value = static_cast<std::size_t>(std::clamp(channel + 0.5, 0.0, 255.0));
    text += kDigits[value / 16];
    text += kDigits[value % 16];
  }
  return text;
}

/// White to `full`, `share` of the way.
std::string shade(const std::array<double, 3>& full, double share) {
  std::array<double, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) rgb[i] = kWhite[i] + std::clamp(share, 0.0, 1.0) * (full[i] - kWhite[i]);
  return hex(rgb);
}

std::string colour_of(double value, const HeatMap& map) {
  if (map.low >= 0.0) return shade(kBlue, (value - map.low) / (map.high - map.low));
  return value < 0.0 ? shade(kOrange, value / map.low) : shade(kBlue, value / map.high);
}

struct Grid {
  double left = 0.0, cell = 0.0, font = 0.0;
  std::size_t rows = 0, columns = 0;

  explicit Grid(const HeatMap& map) : rows(map.values.size()), columns(rows == 0 ? 0 : map.values.front().size()) {
    std::size_t longest = 0;
    for (const std::string& label : map.row_labels) longest = std::max(longest, label.size());
    const auto letters = static_cast<double>(longest);
    left = map.row_labels.empty() ? 0.0 : std::min(kMostLabelPx, letters * 12.0 * kLabelEm) + 8.0;
    const auto most = static_cast<double>(std::max<std::size_t>(1, columns));
    cell = std::clamp((kWidthPx - left) / most, kLeastCellPx, kMostCellPx);
    font = std::clamp(cell - 1.0, 5.0, 12.0);
  }
  double width() const { return std::max(left + cell * static_cast<double>(columns), kScalePx + 120.0); }
  double height() const { return kTopPx + cell * static_cast<double>(rows) + 4.0; }
};

void draw_text(std::string_view text, std::string_view kind, Markup::Attributes place, Markup& svg) {
  svg.open("g", {{"class", kind}, {"fill", kind == "ink" ? "#1B1F24" : "#59636E"}});
  svg.element("text", text, place).close().newline();
}

void draw_scale(const HeatMap& map, Markup& svg) {
  constexpr int kSteps = 36;
  for (int i = 0; i < kSteps; ++i) {
    const double value = map.low + (map.high - map.low) * (i + 0.5) / kSteps;
    svg.empty("rect", {{"x", i * kScalePx / kSteps},
                       {"y", 22.0},
                       {"width", kScalePx / kSteps + 0.5},
                       {"height", 8.0},
                       {"fill", colour_of(value, map)}});
  }
  svg.newline();
  draw_text(significant(map.low, 2), "soft", {{"x", 0.0}, {"y", 44.0}}, svg);
  draw_text(joined({significant(map.high, 2), map.unit.empty() ? "" : " ", map.unit}), "soft",
            {{"x", kScalePx}, {"y", 44.0}, {"text-anchor", "end"}}, svg);
}

void draw_row(const HeatMap& map, const Grid& grid, std::size_t row, Markup& svg) {
  const double y = kTopPx + grid.cell * static_cast<double>(row);
  if (!map.row_labels.empty()) {
    draw_text(shortened(map.row_labels[row], grid.left / (grid.font * kLabelEm)), "soft",
              {{"x", grid.left - 6.0},
               {"y", y + 0.5 * grid.cell + 0.35 * grid.font},
               {"text-anchor", "end"},
               {"font-size", grid.font}},
              svg);
  }
  for (std::size_t c = 0; c < grid.columns; ++c) {
    const double value = map.values[row][c];
    if (!std::isfinite(value)) continue;
    svg.open("rect", {{"x", grid.left + grid.cell * static_cast<double>(c)},
                      {"y", y},
                      {"width", grid.cell - 0.5},
                      {"height", grid.cell - 0.5},
                      {"fill", colour_of(value, map)}});
    const std::string_view across = map.row_labels.size() == grid.columns ? std::string_view(map.row_labels[c]) : "";
    svg.element("title", map.row_labels.empty() ? joined({significant(value, 3), map.unit.empty() ? "" : " ", map.unit})
                                                : joined({map.row_labels[row], across.empty() ? "" : " · ", across,
                                                          ": ", significant(value, 3)}));
    svg.close();
  }
  svg.newline();
}

void require_fitting(const HeatMap& map) {
  require(map.high > map.low, "a scale from low to high");
  require(map.row_labels.empty() || map.row_labels.size() == map.values.size(), "one label a row, or none");
  for (const auto& row : map.values) require(row.size() == map.values.front().size(), "rows of one length");
}

}  // namespace

std::string render_svg(const HeatMap& map) {
  require_fitting(map);
  const Grid grid(map);
  Markup svg;
  svg.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                   {"class", "plot"},
                   {"role", "img"},
                   {"aria-label", map.title},
                   {"viewBox", joined({"0 0 ", coordinate(grid.width()), " ", coordinate(grid.height())})},
                   {"width", grid.width()},
                   {"height", grid.height()},
                   {"font-family", kFont},
                   {"font-size", 12.0}});
  svg.newline().element("title", map.title).newline();
  draw_text(map.title, "ink", {{"y", 15.0}, {"font-size", 15.0}, {"font-weight", "600"}}, svg);
  draw_scale(map, svg);
  for (std::size_t row = 0; row < grid.rows; ++row) draw_row(map, grid, row, svg);
  svg.close().newline();
  return std::move(svg).result();
}

}  // namespace vispline::report
