#include "vispline/report/svg_series.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "vispline/core/error.h"

namespace vispline::report {
namespace {

/// Above that many points a curve is thinned by the area that it inks.
constexpr std::size_t kManyPoints = 20000;
/// Above that many markers shapes would merge: dots instead.
constexpr std::size_t kManyMarkers = 250;

/// Okabe and Ito, https://jfly.uni-koeln.de/color/, without its yellow, which white paper swallows.
constexpr std::array<std::string_view, 8> kPalette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                   "#E69F00", "#56B4E9", "#3D4349", "#7A5195"};
constexpr std::string_view kGuideHex = "#9AA1A9";

std::size_t palette_index(int colour) {
  const int n = static_cast<int>(kPalette.size());
  return static_cast<std::size_t>(((colour % n) + n) % n);
}

std::string pair(Point p) {
  const std::string y = coordinate(p.y);
  return joined({coordinate(p.x), y.starts_with('-') ? "" : " ", y});
}

std::string path_of(const std::vector<std::vector<Point>>& pieces, std::string_view end) {
  std::string d;
  for (const auto& piece : pieces) {
    for (std::size_t i = 0; i < piece.size(); ++i) d += joined({i == 0 ? "M" : "L", pair(piece[i])});
    if (piece.size() == 1) d += "h0";  // a lone point between two gaps: a dot, by the round line cap
    d += end;
  }
  return d;
}

std::vector<std::vector<Point>> stretches(const Series& s, const Axes& axes) {
  std::vector<std::vector<Point>> out(1);
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (drawable(s.x[i], axes.x.log()) && drawable(s.y[i], axes.y.log())) {
      out.back().push_back({axes.x.to_px(s.x[i]), axes.y.to_px(s.y[i])});
    } else if (!out.back().empty()) {
      out.emplace_back();
    }
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

void draw_lines(const Series& s, const std::vector<std::vector<Point>>& pieces, Markup& svg) {
  const std::string d = path_of(pieces, "");
  if (d.empty()) return;
  const bool guide = s.colour == kGuideColour;
  svg.empty("path", {{"d", d},
                     {"fill", "none"},
                     {"stroke", "currentColor"},
                     {"stroke-width", guide ? 1.2 : 1.6},
                     {"stroke-linejoin", "round"},
                     {"stroke-linecap", s.dashed ? "butt" : "round"},
                     {"stroke-dasharray", s.dashed ? "5 4" : "none"}});
}

void draw_dots(const std::vector<Point>& points, Markup& svg) {
  std::string d;
  for (const Point p : points) d += joined({"M", pair(p), "h0"});
  svg.empty("path", {{"d", d}, {"stroke", "currentColor"}, {"stroke-width", 2.4}, {"stroke-linecap", "round"}});
}

void draw_markers(int colour, const std::vector<Point>& points, Markup& svg) {
  if (points.size() > kManyMarkers) return draw_dots(points, svg);
  std::string d;
  for (const Point p : points) d += marker_path(colour, p);
  if (!d.empty()) svg.empty("path", {{"d", d}, {"fill", "currentColor"}});
}

void draw_band(const std::vector<std::vector<Point>>& areas, Markup& svg) {
  const std::string d = path_of(areas, "z");
  if (!d.empty()) svg.empty("path", {{"d", d}, {"fill", "currentColor"}, {"fill-opacity", "0.18"}});
}

void open_coloured(int colour, Markup& svg) {
  svg.open("g", {{"class", colour_class(colour)}, {"color", colour_hex(colour)}});
}

/// Thinned edges, the lower one walked back.
std::vector<Point> outline(std::vector<Point> lower, const std::vector<Point>& upper) {
  std::vector<Point> area = decimate_columns(upper);
  lower = decimate_columns(lower);
  area.insert(area.end(), lower.rbegin(), lower.rend());
  return area;
}

}  // namespace

void check(const Series& s) {
  const bool band = s.style == SeriesStyle::kBand;
  const std::size_t edges = band ? s.x.size() : 0;
  require(s.y.size() == (band ? 0 : s.x.size()), "as many y as x in a plot series, none in a band");
  require(s.lower.size() == edges && s.upper.size() == edges, "as many lower and upper as x in a band, else none");
}

std::vector<std::vector<Point>> curves(const Series& series, const Axes& axes) {
  std::vector<std::vector<Point>> out;
  for (const auto& stretch : stretches(series, axes)) {
    std::vector<Point> thin = decimate_columns(stretch);
    if (thin.size() <= kManyPoints) {
      out.push_back(std::move(thin));
    } else {
      for (auto& piece : decimate_inked(thin)) out.push_back(std::move(piece));
    }
  }
  return out;
}

std::vector<Point> markers(const Series& series, const Axes& axes) {
  std::vector<Point> points;
  for (const auto& stretch : stretches(series, axes)) points.insert(points.end(), stretch.begin(), stretch.end());
  return decimate_pixels(points);
}

std::vector<std::vector<Point>> outlines(const Series& band, const Axes& axes) {
  std::vector<std::vector<Point>> areas;
  std::vector<Point> lower;
  std::vector<Point> upper;
  const auto finish = [&] {
    if (!upper.empty()) areas.push_back(outline(lower, upper));
    lower.clear();
    upper.clear();
  };
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    const bool to_bottom = axes.y.log() && band.lower[i] <= 0.0;
    const bool visible = drawable(band.x[i], axes.x.log()) && drawable(band.upper[i], axes.y.log()) &&
                         (to_bottom || drawable(band.lower[i], axes.y.log()));
    if (!visible) {
      finish();
      continue;
    }
    const double x = axes.x.to_px(band.x[i]);
    upper.push_back({x, axes.y.to_px(band.upper[i])});
    lower.push_back({x, to_bottom ? axes.y.length_px() : axes.y.to_px(band.lower[i])});
  }
  finish();
  return areas;
}

std::string colour_hex(int colour) {
  return std::string(colour == kGuideColour ? kGuideHex : kPalette[palette_index(colour)]);
}

std::string colour_class(int colour) {
  return colour == kGuideColour ? "cg" : joined({"c", std::to_string(palette_index(colour))});
}

std::string marker_path(int colour, Point centre) {
  const auto at = [&](double dx, double dy) { return joined({"M", pair({centre.x + dx, centre.y + dy})}); };
  switch (palette_index(colour) % 4) {
    case 0:
      return at(-3.2, 0) + "a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0-6.4 0z";
    case 1:
      return at(-2.9, -2.9) + "h5.8v5.8h-5.8z";
    case 2:
      return at(0, -3.8) + "l3.6 6.4h-7.2z";
    default:
      return at(0, -4.1) + "l4.1 4.1l-4.1 4.1l-4.1-4.1z";
  }
}

void draw_series(const Series& series, const Axes& axes, Markup& svg) {
  const SeriesStyle style = series.style;
  open_coloured(series.colour, svg);
  if (style == SeriesStyle::kBand) draw_band(outlines(series, axes), svg);
  if (style == SeriesStyle::kLine || style == SeriesStyle::kLineAndPoints)
    draw_lines(series, curves(series, axes), svg);
  if (style == SeriesStyle::kPoints || style == SeriesStyle::kLineAndPoints) {
    draw_markers(series.colour, markers(series, axes), svg);
  }
  svg.close().newline();
}

void draw_sample(const Series& series, double x, double y, Markup& svg) {
  const SeriesStyle style = series.style;
  open_coloured(series.colour, svg);
  if (style == SeriesStyle::kBand) draw_band({{{x, y - 5}, {x + 22, y - 5}, {x + 22, y + 5}, {x, y + 5}}}, svg);
  if (style == SeriesStyle::kLine || style == SeriesStyle::kLineAndPoints) {
    draw_lines(series, {{{x, y}, {x + 22, y}}}, svg);
  }
  if (style == SeriesStyle::kPoints || style == SeriesStyle::kLineAndPoints) {
    draw_markers(series.colour, {{x + 11, y}}, svg);
  }
  svg.close();
}

}  // namespace vispline::report
