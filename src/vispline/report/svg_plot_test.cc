#include "vispline/report/svg_plot.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <random>

#include "vispline/core/error.h"
#include "vispline/report/escape.h"
#include "vispline/report/markup_testing.h"
#include "vispline/report/svg_layout.h"
#include "vispline/report/svg_series.h"

namespace vispline::report {
namespace {

Series line(std::vector<double> x, std::vector<double> y) {
  Series s;
  s.name = "gyro x";
  s.x = std::move(x);
  s.y = std::move(y);
  return s;
}

Series band(std::vector<double> x, std::vector<double> lower, std::vector<double> upper) {
  Series s;
  s.style = SeriesStyle::kBand;
  s.x = std::move(x);
  s.lower = std::move(lower);
  s.upper = std::move(upper);
  return s;
}

Plot plot_of(Series series) {
  Plot plot;
  plot.title = "Angular rate";
  plot.x_label = "time [s]";
  plot.y_label = "rate [rad/s]";
  plot.series.push_back(std::move(series));
  return plot;
}

/// Parses, and holds no number that is not one.
MarkupReader read_back(const Plot& plot) {
  const std::string svg = render_svg(plot);
  MarkupReader read(svg);
  for (const auto& e : read.elements) {
    for (const auto& [name, value] : e.attributes) {
      if (name != "d" && name != "x" && name != "y" && name != "viewBox") continue;
      EXPECT_EQ(value.find("nan"), std::string::npos) << value;
      EXPECT_EQ(value.find("inf"), std::string::npos) << value;
    }
  }
  return read;
}

TEST(SvgPlot, IsOneElementForItself) {
  const MarkupReader read = read_back(plot_of(line({0, 1, 2}, {0, 1, 0})));
  EXPECT_EQ(read.elements[0].name, "svg");
  EXPECT_EQ(read.elements[0].attributes.at("xmlns"), "http://www.w3.org/2000/svg");
  EXPECT_EQ(read.elements[0].attributes.at("aria-label"), "Angular rate");
  EXPECT_EQ(read.elements[0].attributes.at("role"), "img");
  EXPECT_EQ(read.elements[1].name, "title");
  EXPECT_EQ(read.elements[1].text, "Angular rate");
  for (const auto& e : read.elements) {
    for (const char* name : {"style", "href", "id", "clip-path"}) EXPECT_FALSE(e.attributes.contains(name)) << e.name;
  }
}

TEST(SvgPlot, HostileNamesChangeNothingButText) {
  const auto shape = [](const std::string& name) {
    Plot plot = plot_of(line({0, 1, 2}, {0, 1, 0}));
    plot.title = plot.x_label = plot.y_label = plot.series[0].name = name;
    plot.annotations = {{1.0, 0.5, name}};
    return read_back(plot).shape();
  };
  const auto plain = shape("gyro");
  std::mt19937 generator(21);
  for (int i = 0; i < 300; ++i) EXPECT_EQ(shape(hostile_text(generator)), plain);
  EXPECT_EQ(shape(std::string(100000, '<')), plain);
}

TEST(SvgPlot, DegenerateSeriesStillDraw) {
  const double nan = std::nan("");
  const std::vector<std::vector<double>> ys{{},          {3.0},          {2.5, 2.5, 2.5},   {0.0, 0.0},
                                            {nan, nan},  {nan, 1, nan},  {-1, 0, HUGE_VAL}, {1e308, -1e308},
                                            {5e-324, 0}, {1, 1 + 1e-15}, {-1e300, 1e300}};
  for (const auto& y : ys) {
    for (const SeriesStyle style : {SeriesStyle::kLine, SeriesStyle::kPoints, SeriesStyle::kLineAndPoints}) {
      for (const int axes : {0, 1, 2, 3}) {
        std::vector<double> x;
        for (std::size_t i = 0; i < y.size(); ++i) x.push_back(static_cast<double>(i) - 1.0);
        Plot plot = plot_of(line(x, y));
        plot.series[0].style = style;
        plot.log_x = (axes & 1) != 0;
        plot.log_y = (axes & 2) != 0;
        EXPECT_GE(read_back(plot).named("text").size(), 8U);  // labels and at least three ticks on both axes
        if (axes == 0) {
          plot.equal_aspect = true;
          read_back(plot);
        }
      }
    }
  }
  EXPECT_NO_THROW(read_back(Plot{}));
}

TEST(SvgPlot, RefusesWhatDoesNotFit) {
  EXPECT_THROW(render_svg(plot_of(line({0, 1}, {0}))), Error);
  EXPECT_THROW(render_svg(plot_of(band({0, 1}, {0}, {1, 1}))), Error);
  Plot plot = plot_of(line({0, 1}, {0, 1}));
  EXPECT_THROW(render_svg(plot, 20.0), Error);
  EXPECT_THROW(render_svg(plot, std::nan("")), Error);
  plot.y_range = Range{1.0, 1.0};
  EXPECT_THROW(render_svg(plot), Error);
  plot.y_range = Range{-1.0, 1.0};
  EXPECT_NO_THROW(render_svg(plot));
  plot.log_y = true;
  EXPECT_THROW(render_svg(plot), Error);
}

TEST(SvgPlot, SameBytesInEveryLocale) {
  const Plot plot = plot_of(line({0.0, 0.7, 1.9}, {0.25, 1e-3, 0.125}));
  const std::string first = render_svg(plot);
  const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(render_svg(plot), first);
  if (german != nullptr) std::setlocale(LC_ALL, "C");
}

TEST(SvgPlot, LongSignalsAreSmallAndKeepSpikes) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  Series s = line({}, {});
  for (int i = 0; i < 1000000; ++i) {
    s.x.push_back(0.005 * i);
    s.y.push_back(normal(generator));
  }
  const std::size_t quiet = render_svg(plot_of(s)).size();
  EXPECT_LT(quiet, 80000U);
  s.y[123456] = 50.0;
  const Axes axes = make_axes(plot_of(s), 700.0, 300.0);
  double highest = 1e9;
  for (const auto& piece : curves(s, axes)) {
    for (const Point p : piece) highest = std::min(highest, p.y);
  }
  EXPECT_DOUBLE_EQ(highest, axes.y.to_px(50.0));
}

TEST(SvgSeries, GapsBreakTheLine) {
  const Series s = line({0, 1, 2, 3, 4}, {1, 2, std::nan(""), 3, 4});
  EXPECT_EQ(curves(s, make_axes(plot_of(s), 700.0, 300.0)).size(), 2U);
  Plot log = plot_of(line({0, 1, 2, 3, 4}, {1, 0, 3, -1, 4}));
  log.log_y = true;
  EXPECT_EQ(curves(log.series[0], make_axes(log, 700.0, 300.0)).size(), 3U);
}

TEST(SvgSeries, ABandBelowALogAxisReachesTheBottom) {
  Plot plot = plot_of(band({1, 2, 3, 4, 5}, {-1, 0.5, 0.5, 0.5, 0.5}, {2, 2, std::nan(""), 2, 3}));
  plot.log_y = true;
  const Axes axes = make_axes(plot, 700.0, 300.0);
  const auto areas = outlines(plot.series[0], axes);
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_EQ(areas[0].size(), 4U);
  EXPECT_DOUBLE_EQ(areas[0].back().y, 300.0);
  EXPECT_DOUBLE_EQ(areas[0].front().y, axes.y.to_px(2.0));
}

TEST(SvgSeries, ColoursRepeatInACircle) {
  EXPECT_EQ(colour_hex(0), "#0072B2");
  EXPECT_EQ(colour_hex(8), colour_hex(0));
  EXPECT_EQ(colour_class(-2), "c6");
  EXPECT_EQ(colour_class(kGuideColour), "cg");
}

TEST(Axis, EqualAspectHasOneScale) {
  Plot plot = plot_of(line({-10, 20}, {-15, 25}));
  plot.equal_aspect = true;
  const Axes axes = make_axes(plot, 640.0, 310.0);
  EXPECT_NEAR(axes.x.to_px(1.0) - axes.x.to_px(0.0), axes.y.to_px(0.0) - axes.y.to_px(1.0), 1e-9);
  EXPECT_GE(axes.y.to_px(25.0), 0.0);
  EXPECT_LE(axes.y.to_px(-15.0), 310.0);
}

TEST(Axis, TimeReachesTheRoundNumberThatItAllButReaches) {
  const Axes axes = make_axes(plot_of(line({0.0, 19.995}, {0.0, 1.0})), 700.0, 300.0);
  EXPECT_EQ(axes.x.range().hi, 20.0);
  EXPECT_EQ(axes.x.range().lo, 0.0);
  const Axes other = make_axes(plot_of(line({0.0, 17.4}, {0.0, 1.0})), 700.0, 300.0);
  EXPECT_EQ(other.x.range().hi, 17.4);
}

TEST(Axis, DecadesAreEquallyLong) {
  const Axis axis({1e-3, 1e3}, true, 600.0, false);
  EXPECT_NEAR(axis.to_px(1e-3), 0.0, 1e-9);
  EXPECT_NEAR(axis.to_px(0.1), 200.0, 1e-9);
  EXPECT_NEAR(axis.to_px(1e3), 600.0, 1e-9);
}

TEST(Legend, RowsStayInsideTheDrawing) {
  Plot plot;
  for (int i = 0; i < 12; ++i) {
    plot.series.push_back(line({0}, {0}));
    plot.series.back().name = std::string(static_cast<std::size_t>(3 + 7 * i), 'n');
  }
  plot.series[4].name.clear();
  const Legend legend = make_legend(plot, 390.0);
  EXPECT_EQ(legend.items.size(), 11U);
  for (std::size_t i = 0; i < legend.items.size(); ++i) {
    const auto& item = legend.items[i];
    EXPECT_LE(item.x + kSamplePx + kFontPx * text_width_em(item.text), 390.0 + 1e-9);
    EXPECT_LT(item.y, legend.height_px);
    const bool new_row = i == 0 || item.y > legend.items[i - 1].y;
    EXPECT_TRUE(new_row ? item.x == 0.0 : item.x > legend.items[i - 1].x + kSamplePx);
  }
}

TEST(Labels, NeighboursDoNotTouch) {
  Plot plot = plot_of(line({1e9, 1e9 + 0.001}, {0, 1}));
  const Axes axes = make_axes(plot, 300.0, 200.0);
  const Ticks ticks = ticks_of(axes.x, kXSpacingPx);
  const std::size_t stride = label_stride(ticks, axes.x, widest_px(ticks) + 8.0);
  ASSERT_GT(ticks.major.size(), 1U);
  const double step = axes.x.to_px(ticks.major[1].value) - axes.x.to_px(ticks.major[0].value);
  EXPECT_GE(static_cast<double>(stride) * step, widest_px(ticks));
}

}  // namespace
}  // namespace vispline::report
