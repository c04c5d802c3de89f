#include "vispline/report/calibration_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "vispline/report/number.h"

namespace vispline::report {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kColumns = 16, kRows = 12;
constexpr std::size_t kFewest = 5;  // residuals in a region, for a mean to be drawn

Series guide(std::vector<double> x, std::vector<double> y, std::string name = "") {
  Series series{.name = std::move(name), .x = std::move(x), .y = std::move(y)};
  series.colour = kGuideColour;
  series.dashed = true;
  return series;
}

Series circle(double radius) {
  std::vector<double> x, y;
  for (int i = 0; i <= 72; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 72.0;
    x.push_back(radius * std::cos(angle));
    y.push_back(radius * std::sin(angle));
  }
  Series series = guide(std::move(x), std::move(y));
  series.colour = 1;
  return series;
}

/// Sum of residuals by region of the image.
struct Regions {
  struct Region {
    std::size_t count = 0;
    Vector2d sum = Vector2d::Zero();
  };
  Vector2d low, size;
  std::array<Region, kColumns * kRows> region{};

  explicit Regions(const SensorResiduals& r) {
    Vector2d high = r.px.front();
    low = high;
    for (const Vector2d& px : r.px) {
      low = low.cwiseMin(px);
      high = high.cwiseMax(px);
    }
    size = (high - low).cwiseMax(1.0).cwiseQuotient(Vector2d(kColumns, kRows));
    for (std::size_t i = 0; i < r.px.size(); ++i) {
      const Vector2d residual(r.residual[0][i], r.residual[1][i]);
      if (residual.cwiseAbs().maxCoeff() > 4.0 * r.sigma) continue;  // a few outliers would be all that is seen
      const Vector2d at = (r.px[i] - low).cwiseQuotient(size);
      const auto column = std::min(kColumns - 1, static_cast<std::size_t>(at.x()));
      const auto row = std::min(kRows - 1, static_cast<std::size_t>(at.y()));
      Region& region_at = region[row * kColumns + column];
      ++region_at.count;
      region_at.sum += residual;
    }
  }

  Vector2d centre(std::size_t i) const {
    return low + size.cwiseProduct(
                     Vector2d(0.5 + static_cast<double>(i % kColumns), 0.5 + static_cast<double>(i / kColumns)));
  }
  Vector2d mean(std::size_t i) const { return region[i].sum / static_cast<double>(region[i].count); }
};

void add_line(Series& series, const Vector2d& from, const Vector2d& to) {
  for (const Vector2d& p : {from, to}) {
    series.x.push_back(p.x());
    series.y.push_back(-p.y());  // rows count downwards
  }
  series.x.push_back(kGap);
  series.y.push_back(kGap);
}

void add_arrow(Series& series, const Vector2d& from, const Vector2d& arrow) {
  const Vector2d tip = from + arrow, across(-arrow.y(), arrow.x());
  add_line(series, from, tip);
  add_line(series, tip, tip - 0.25 * arrow + 0.15 * across);
  add_line(series, tip, tip - 0.25 * arrow - 0.15 * across);
}

struct Axis3 {
  std::array<std::vector<double>, 3> p{};
  std::vector<double> seconds{};

  Axis3(const Signal<Pose>& poses, Time begin) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      seconds.push_back(to_seconds(poses.time[i] - begin));
      for (std::size_t k = 0; k < 3; ++k) p[k].push_back(poses.value[i].p(static_cast<Eigen::Index>(k)));
    }
  }
};

Series line(std::string name, std::vector<double> x, std::vector<double> y, int colour) {
  Series series{.name = std::move(name), .x = std::move(x), .y = std::move(y)};
  series.colour = colour;
  return series;
}

}  // namespace

HeatMap correlation_map(const CalibrationResult& result) {
  HeatMap map{.title = "Correlation of the estimated numbers", .row_labels = result.correlation_labels};
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    const Eigen::VectorXd row = result.correlation.row(i);
    map.values.emplace_back(row.data(), row.data() + row.size());
  }
  map.caption =
      "Columns stand in the order of the rows. Blue moves together, orange against each other; point at a cell "
      "for its value.";
  return map;
}

Plot residual_plot(const SensorResiduals& r) {
  Plot plot{.title = r.sensor, .x_label = "time [s]", .y_label = joined({"residual [", r.unit, "]"})};
  const bool pixels = !r.px.empty();
  for (std::size_t k = 0; k < r.residual.size(); ++k) {
    Series series = line(std::string(1, (pixels ? "uvw" : "xyz")[k]), r.time_s, r.residual[k], static_cast<int>(k));
    series.style = SeriesStyle::kPoints;
    plot.series.push_back(std::move(series));
  }
  if (r.time_s.empty()) return plot;
  const std::vector<double> ends{r.time_s.front(), r.time_s.back()};
  for (const double sigmas : {-3.0, 3.0}) {
    plot.series.push_back(guide(ends, {sigmas * r.sigma, sigmas * r.sigma}, sigmas > 0.0 ? "3 sigma" : ""));
  }
  plot.height_px = 180.0;
  return plot;
}

Plot reprojection_plot(const SensorResiduals& r) {
  Plot plot{.title = joined({r.sensor, ": where the pixels missed"}), .x_label = "u [px]", .y_label = "v [px]"};
  Series points = line("", r.residual[0], r.residual[1], 0);
  points.style = SeriesStyle::kPoints;
  plot.series = {points, circle(r.sigma), circle(3.0 * r.sigma)};
  plot.equal_aspect = true;
  plot.width_px = 400.0;
  const double reach = 5.0 * std::max(r.sigma, r.rms);
  plot.x_range = plot.y_range = Range{-reach, reach};
  return plot;
}

Plot region_plot(const SensorResiduals& r) {
  Plot plot{.title = "", .x_label = "column [px]", .y_label = "minus row [px]"};
  plot.equal_aspect = true;
  plot.width_px = 400.0;
  if (r.px.empty()) return plot;
  const Regions regions(r);
  double largest = 0.0;
  for (std::size_t i = 0; i < regions.region.size(); ++i) {
    if (regions.region[i].count >= kFewest) largest = std::max(largest, regions.mean(i).norm());
  }
  const double scale = largest > 0.0 ? 0.9 * regions.size.minCoeff() / largest : 0.0;
  Series arrows = line("", {}, {}, 1);
  for (std::size_t i = 0; i < regions.region.size(); ++i) {
    if (regions.region[i].count >= kFewest) add_arrow(arrows, regions.centre(i), scale * regions.mean(i));
  }
  plot.series.push_back(std::move(arrows));
  plot.title = joined({r.sensor, ": means, longest ", significant(largest, 2), " px"});
  return plot;
}

std::vector<Plot> course_plots(const CalibrationCourse& course) {
  const Time begin = course.T_w_b.time.front();
  const Axis3 estimate(course.T_w_b, begin), truth(course.truth_T_w_b, begin);
  const bool known = !truth.seconds.empty();
  Plot top{.title = "From above", .x_label = "x [m]", .y_label = "y [m]"};
  if (known) top.series.push_back(line("truth", truth.p[0], truth.p[1], kGuideColour));
  top.series.push_back(line(known ? "estimate" : "", estimate.p[0], estimate.p[1], 0));
  top.equal_aspect = true;
  Plot time{.title = "Position", .x_label = "time [s]", .y_label = "position [m]"};
  for (std::size_t k = 0; k < 3; ++k) {
    if (known) {
      time.series.push_back(line(k == 0 ? "truth" : "", truth.seconds, truth.p[k], kGuideColour));
      time.series.back().dashed = true;
    }
    time.series.push_back(line(std::string(1, "xyz"[k]), estimate.seconds, estimate.p[k], static_cast<int>(k)));
  }
  top.width_px = time.width_px = 400.0;
  return {top, time};
}

std::optional<Plot> course_error_plot(const CalibrationCourse& course) {
  if (course.truth_T_w_b.size() == 0) return std::nullopt;
  std::vector<double> seconds, error;
  std::size_t j = 0;
  for (std::size_t i = 0; i < course.truth_T_w_b.size(); ++i) {
    const Time time = course.truth_T_w_b.time[i];
    while (j + 1 < course.T_w_b.size() && course.T_w_b.time[j + 1] <= time) ++j;
    if (j + 1 >= course.T_w_b.size() || course.T_w_b.time[j] > time) continue;
    const double u =
        to_seconds(time - course.T_w_b.time[j]) / to_seconds(course.T_w_b.time[j + 1] - course.T_w_b.time[j]);
    const Vector3d p = (1.0 - u) * course.T_w_b.value[j].p + u * course.T_w_b.value[j + 1].p;
    seconds.push_back(to_seconds(time - course.T_w_b.time.front()));
    error.push_back(1e3 * (p - course.truth_T_w_b.value[i].p).norm());
  }
  Plot plot{.title = "Distance from the truth", .x_label = "time [s]", .y_label = "distance [mm]"};
  plot.series.push_back(line("", std::move(seconds), std::move(error), 1));
  plot.height_px = 160.0;
  return plot;
}

}  // namespace vispline::report
