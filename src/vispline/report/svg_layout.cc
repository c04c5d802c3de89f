#include "vispline/report/svg_layout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "vispline/report/escape.h"

namespace vispline::report {
namespace {

constexpr double kLinePx = 20.0;   ///< a row of the legend
constexpr double kBelowPx = 44.0;  ///< tick labels and the x label
constexpr double kItemGapPx = 18.0;

double label_px(const TickLabel& label) {
  const double exponent = label.exponent ? 0.7 * text_width_em(std::to_string(*label.exponent)) : 0.0;
  return kFontPx * (text_width_em(label.text) + exponent);
}

int target_count(double length_px, double spacing_px) {
  return std::clamp(static_cast<int>(std::lround(length_px / spacing_px)), 4, 9);
}

}  // namespace

Ticks ticks_of(const Axis& axis, double spacing_px) {
  return axis.log() ? log_ticks(axis.range()) : linear_ticks(axis.range(), target_count(axis.length_px(), spacing_px));
}

Legend make_legend(const Plot& plot, double width_px) {
  Legend legend;
  double x = 0.0;
  for (const Series& series : plot.series) {
    if (series.name.empty()) continue;
    std::string text = shortened(series.name, (width_px - kSamplePx) / kFontPx);
    const double width = kSamplePx + kFontPx * text_width_em(text);
    if (x > 0.0 && x + width > width_px) {
      x = 0.0;
      legend.height_px += kLinePx;
    }
    legend.items.push_back({&series, std::move(text), x, legend.height_px + 0.5 * kLinePx});
    x += width + kItemGapPx;
  }
  if (!legend.items.empty()) legend.height_px += kLinePx + 4.0;
  return legend;
}

Layout make_layout(const Plot& plot, const Legend& legend, double width_px) {
  const double title = plot.title.empty() ? 2.0 : 26.0;
  const double y_label = plot.y_label.empty() ? 8.0 : 24.0;
  const double top = title + legend.height_px + y_label;
  // Margins follow from the labels, which hardly depend on the width that the margins leave.
  const Axes axes = make_axes(plot, 0.85 * width_px, plot.height_px);
  const double left = std::min(widest_px(ticks_of(axes.y, kYSpacingPx)) + 12.0, 0.4 * width_px);
  const double right = std::clamp(0.5 * widest_px(ticks_of(axes.x, kXSpacingPx)) + 2.0, 14.0, 0.2 * width_px);
  return {.left = left,
          .top = top,
          .width = width_px - left - right,
          .height = plot.height_px,
          .total_width = width_px,
          .total_height = top + plot.height_px + kBelowPx,
          .legend_top = title};
}

double widest_px(const Ticks& ticks) {
  double widest = 0.0;
  for (const Tick& tick : ticks.major) widest = std::max(widest, label_px(tick.label));
  return widest;
}

std::size_t label_stride(const Ticks& ticks, const Axis& axis, double label_px) {
  double closest = axis.length_px();
  for (std::size_t i = 1; i < ticks.major.size(); ++i) {
    closest = std::min(closest, std::abs(axis.to_px(ticks.major[i].value) - axis.to_px(ticks.major[i - 1].value)));
  }
  return static_cast<std::size_t>(std::ceil(label_px / std::max(closest, 1.0)));
}

}  // namespace vispline::report
