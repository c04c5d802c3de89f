#include "vispline/report/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "vispline/core/error.h"
#include "vispline/report/escape.h"
#include "vispline/report/svg_layout.h"
#include "vispline/report/svg_series.h"

namespace vispline::report {
namespace {

constexpr std::string_view kFont = "system-ui, -apple-system, Segoe UI, Roboto, Helvetica Neue, Arial, sans-serif";
constexpr double kBoldness = 1.12;  ///< how much wider the title runs than text of its size
constexpr std::string_view kInk = "#1B1F24";
constexpr std::string_view kSoft = "#59636E";
constexpr std::string_view kPaper = "#FFFFFF";

void draw_text(std::string_view text, std::string_view kind, Markup::Attributes place, Markup& svg) {
  svg.open("g", {{"class", kind}, {"fill", kind == "ink" ? kInk : kSoft}});
  svg.element("text", text, place).close().newline();
}

void draw_tick_label(const TickLabel& label, double x, double y, std::string_view anchor, Markup& svg) {
  svg.open("text", {{"x", x}, {"y", y}, {"text-anchor", anchor}}).text(label.text);
  if (label.exponent) {
    const std::string sign = *label.exponent < 0 ? "−" : "";
    svg.element("tspan", joined({sign, std::to_string(std::abs(*label.exponent))}),
                {{"dy", "-0.45em"}, {"font-size", "9"}});
  }
  svg.close();
}

/// Lines of the grid as one path: x of vertical ones, y of horizontal ones, in pixels.
void draw_grid(const std::vector<double>& x, const std::vector<double>& y, const Layout& box, std::string_view kind,
               Markup& svg) {
  std::string d;
  for (const double px : x) d += joined({"M", coordinate(px), " 0v", coordinate(box.height)});
  for (const double px : y) d += joined({"M0 ", coordinate(px), "h", coordinate(box.width)});
  if (d.empty()) return;
  svg.empty("path", {{"class", kind}, {"d", d}, {"stroke", kind == "grid" ? "#DFE3E8" : "#EFF1F4"}}).newline();
}

std::vector<double> pixels(const std::vector<double>& values, const Axis& axis) {
  std::vector<double> px;
  for (const double value : values) px.push_back(axis.to_px(value));
  return px;
}

std::vector<double> values(const std::vector<Tick>& ticks) {
  std::vector<double> out;
  for (const Tick& tick : ticks) out.push_back(tick.value);
  return out;
}

void draw_labels(const Ticks& x, const Ticks& y, const Axes& axes, const Layout& box, Markup& svg) {
  svg.open("g", {{"class", "soft"}, {"fill", kSoft}});
  const std::size_t x_stride = label_stride(x, axes.x, widest_px(x) + 8.0);
  for (std::size_t i = 0; i < x.major.size(); i += x_stride) {
    draw_tick_label(x.major[i].label, axes.x.to_px(x.major[i].value), box.height + 18.0, "middle", svg);
  }
  const std::size_t y_stride = label_stride(y, axes.y, kFontPx + 2.0);
  for (std::size_t i = 0; i < y.major.size(); i += y_stride) {
    draw_tick_label(y.major[i].label, -8.0, axes.y.to_px(y.major[i].value) + 4.0, "end", svg);
  }
  svg.close().newline();
}

void draw_axes(const Axes& axes, const Layout& box, Markup& svg) {
  const Ticks x = ticks_of(axes.x, kXSpacingPx);
  const Ticks y = ticks_of(axes.y, kYSpacingPx);
  draw_grid(pixels(x.minor, axes.x), pixels(y.minor, axes.y), box, "minor", svg);
  draw_grid(pixels(values(x.major), axes.x), pixels(values(y.major), axes.y), box, "grid", svg);
  draw_labels(x, y, axes, box, svg);
}

/// A nested <svg> clips at its edge without needing an id, which a page with several plots would have to keep unique.
void draw_data(const Plot& plot, const Axes& axes, const Layout& box, Markup& svg) {
  svg.open("svg", {{"width", box.width}, {"height", box.height}, {"overflow", "hidden"}}).newline();
  const auto band_first = [&](bool band) {
    for (const Series& series : plot.series) {
      if ((series.style == SeriesStyle::kBand) == band) draw_series(series, axes, svg);
    }
  };
  band_first(true);
  band_first(false);
  svg.close().newline();
}

void draw_frame(const Layout& box, Markup& svg) {
  const std::string d = joined({"M0 0v", coordinate(box.height), "h", coordinate(box.width)});
  svg.empty("path", {{"class", "axis"}, {"d", d}, {"fill", "none"}, {"stroke", "#7C858F"}}).newline();
}

/// Beside the point, on the side that is asked for or has room.
void draw_annotation(const Annotation& note, const Axes& axes, Markup& svg) {
  if (!drawable(note.x, axes.x.log()) || !drawable(note.y, axes.y.log())) return;
  const double x = axes.x.to_px(note.x);
  const double y = axes.y.to_px(note.y);
  if (x < 0.0 || x > axes.x.length_px() || y < 0.0 || y > axes.y.length_px()) return;
  const bool left = note.side == Side::kLeft || (note.side == Side::kRoom && x > 0.6 * axes.x.length_px());
  const double room = left ? x - 6.0 : axes.x.length_px() - x - 6.0;
  svg.open("g", {{"class", "halo"}, {"fill", kInk}, {"stroke", kPaper}, {"paint-order", "stroke"}});
  svg.element("text", shortened(note.text, room / kFontPx),
              {{"x", left ? x - 6.0 : x + 6.0},
               {"y", y < 20.0 ? y + 14.0 : y - 6.0},
               {"text-anchor", left ? "end" : "start"},
               {"stroke-width", 3.0},
               {"stroke-linejoin", "round"}});
  svg.close().newline();
}

void draw_header(const Plot& plot, const Legend& legend, const Layout& box, Markup& svg) {
  if (!plot.title.empty()) {
    draw_text(shortened(plot.title, box.total_width / (kBoldness * kTitlePx)), "ink",
              {{"y", 15.0}, {"font-size", kTitlePx}, {"font-weight", "600"}}, svg);
  }
  for (const LegendItem& item : legend.items) {
    const double y = box.legend_top + item.y;
    draw_sample(*item.series, item.x, y, svg);
    draw_text(item.text, "ink", {{"x", item.x + kSamplePx}, {"y", y + 4.0}}, svg);
  }
}

void draw_axis_names(const Plot& plot, const Layout& box, Markup& svg) {
  const double room_em = box.total_width / kFontPx;
  if (!plot.y_label.empty()) draw_text(shortened(plot.y_label, room_em), "soft", {{"y", box.top - 10.0}}, svg);
  if (plot.x_label.empty()) return;
  draw_text(shortened(plot.x_label, box.width / kFontPx), "soft",
            {{"x", box.left + 0.5 * box.width}, {"y", box.total_height - 6.0}, {"text-anchor", "middle"}}, svg);
}

void open_svg(const Plot& plot, const Layout& box, Markup& svg) {
  svg.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                   {"class", "plot"},
                   {"role", "img"},
                   {"aria-label", plot.title},
                   {"viewBox", joined({"0 0 ", coordinate(box.total_width), " ", coordinate(box.total_height)})},
                   {"width", box.total_width},
                   {"height", box.total_height},
                   {"font-family", kFont},
                   {"font-size", kFontPx}});
  svg.newline().element("title", plot.title).newline();
  svg.empty("rect", {{"class", "paper"}, {"width", box.total_width}, {"height", box.total_height}, {"fill", kPaper}});
  svg.newline();
}

/// What lies in the coordinates of the box.
void draw_box(const Plot& plot, const Layout& box, Markup& svg) {
  const Axes axes = make_axes(plot, box.width, box.height);
  svg.open("g", {{"transform", joined({"translate(", coordinate(box.left), " ", coordinate(box.top), ")"})}}).newline();
  draw_axes(axes, box, svg);
  draw_data(plot, axes, box, svg);
  draw_frame(box, svg);
  for (const Annotation& note : plot.annotations) draw_annotation(note, axes, svg);
  svg.close().newline();
}

}  // namespace

std::string render_svg(const Plot& plot) { return render_svg(plot, plot.width_px); }

std::string render_svg(const Plot& plot, double width_px) {
  require(width_px >= 200.0 && width_px <= 1e4, "a plot width between 200 and 10000 px");
  require(plot.height_px >= 60.0 && plot.height_px <= 1e4, "a plot height between 60 and 10000 px");
  std::for_each(plot.series.begin(), plot.series.end(), check);
  const Legend legend = make_legend(plot, width_px);
  const Layout box = make_layout(plot, legend, width_px);
  Markup svg;
  open_svg(plot, box, svg);
  draw_header(plot, legend, box, svg);
  draw_axis_names(plot, box, svg);
  draw_box(plot, box, svg);
  svg.close().newline();
  return std::move(svg).result();
}

}  // namespace vispline::report
