#include "vispline/report/allan_plots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vispline/report/number.h"
#include "vispline/results/allan_words.h"

namespace vispline::report {
namespace {

constexpr double kPairHeightPx = 270.0;
constexpr double kWideHeightPx = 380.0;

std::string in_brackets(const std::string& unit) { return unit.empty() ? "" : joined({" [", pretty_unit(unit), "]"}); }

std::string title_of(const SignalAnalysis& signal) {
  return signal.axis.empty() ? signal.sensor : joined({signal.sensor, " ", signal.axis});
}

Series line(const std::string& name, std::vector<double> x, std::vector<double> y, int colour) {
  Series series;
  series.name = name;
  series.x = std::move(x);
  series.y = std::move(y);
  series.colour = colour;
  return series;
}

Series band(const std::string& name, const AllanCurve& curve, int colour) {
  Series series;
  series.name = name;
  series.style = SeriesStyle::kBand;
  series.x = curve.tau_s;
  series.lower = curve.low;
  series.upper = curve.high;
  series.colour = colour;
  return series;
}

Plot deviation_plot(const std::string& title, const std::string& y_label) {
  Plot plot;
  plot.title = title;
  plot.x_label = "averaging time τ [s]";
  plot.y_label = y_label;
  plot.log_x = plot.log_y = true;
  plot.height_px = kPairHeightPx;
  return plot;
}

std::string deviation_name(Deviation kind) {
  switch (kind) {
    case Deviation::kOadev:
      return "overlapping Allan deviation";
    case Deviation::kAdev:
      return "Allan deviation";
    case Deviation::kMdev:
      return "modified Allan deviation";
    case Deviation::kTdev:
      return "time deviation";
    case Deviation::kHdev:
      return "Hadamard deviation";
    case Deviation::kOhdev:
      return "overlapping Hadamard deviation";
    case Deviation::kTotdev:
      return "total deviation";
  }
  return "deviation";
}

std::string slope_label(Term term) {
  constexpr std::array<const char*, kTerms> kSlopes{"−1", "−1/2", "flat", "+1/2", "+1"};
  return joined({symbol_of(term), " ", kSlopes[static_cast<std::size_t>(term)]});
}

/// From below the curve, so that every term can be followed to where it vanishes, to above it.
Range range_around(const AllanCurve& curve) {
  const auto [lowest, highest] = std::minmax_element(curve.value.begin(), curve.value.end());
  return {*lowest / 6.0, *highest * 2.0};
}

/// A term's name stands on the free side of its line, near the bottom of the box where the lines part; names of terms
/// that can come close stand at different heights.
Annotation name_beside(Term term, const std::vector<double>& tau_s, const std::vector<double>& y, const Range& box) {
  constexpr std::array<double, kTerms> kHeight{2.6, 1.5, 0.0, 1.5, 3.2};  // above the bottom, as a factor
  const bool falling = term == Term::kQuantization || term == Term::kWhite;
  Annotation note;
  note.text = slope_label(term);
  note.side = falling || term == Term::kFlicker ? Side::kRight : Side::kLeft;
  const double lowest = kHeight[static_cast<std::size_t>(term)] * box.lo;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const std::size_t i = falling ? y.size() - 1 - k : k;
    const bool at_the_edge = falling && tau_s[i] > 0.15 * tau_s.back();
    if (y[i] < lowest || y[i] > box.hi || at_the_edge) continue;
    note.x = tau_s[i];
    note.y = y[i];
    break;
  }
  return note;
}

void add_term(Plot& plot, const SignalAnalysis& signal, Term term, const std::vector<double>& tau_s) {
  std::vector<double> y;
  for (const double tau : tau_s) y.push_back(deviation_of(term, signal.terms[term].value, tau));
  plot.annotations.push_back(name_beside(term, tau_s, y, *plot.y_range));
  plot.series.push_back(line("", tau_s, std::move(y), kGuideColour));
}

std::vector<double> fitted(const SignalAnalysis& signal, const std::vector<double>& tau_s) {
  std::vector<double> y;
  for (const double tau : tau_s) y.push_back(signal.terms.deviation(tau));
  return y;
}

/// Symmetric about 0, as the measured values need; intervals may leave it.
Range residual_range(const std::vector<double>& values) {
  double largest = 1.0;
  for (const double value : values) largest = std::max(largest, std::isfinite(value) ? std::abs(value) : 0.0);
  const double limit = std::min(1.6 * largest, 100.0);
  return {-limit, limit};
}

}  // namespace

std::string pretty_unit(std::string unit) {
  const auto replace = [&](std::string_view from, std::string_view to) {
    for (std::size_t at = unit.find(from); at != std::string::npos; at = unit.find(from, at + to.size())) {
      unit.replace(at, from.size(), to);
    }
  };
  replace("sqrt(Hz)", "√Hz");
  replace("^2", "²");
  replace("^3", "³");
  replace("*", "·");
  return unit;
}

Plot curves_plot(const AllanResult& result, const SensorSummary& sensor, Deviation kind) {
  const std::string name = deviation_name(kind);
  Plot plot = deviation_plot("", name + in_brackets(curve_unit(kind, sensor.unit)));
  plot.height_px = kWideHeightPx;
  for (std::size_t k = 0; k < sensor.signals.size(); ++k) {
    const SignalAnalysis& signal = result.signals[sensor.signals[k]];
    for (const AllanCurve& curve : signal.curves) {
      if (curve.deviation != kind) continue;
      const int colour = static_cast<int>(k);
      plot.series.push_back(band("", curve, colour));
      plot.series.push_back(line(title_of(signal), curve.tau_s, curve.value, colour));
    }
  }
  return plot;
}

Plot terms_plot(const SignalAnalysis& signal) {
  const AllanCurve& curve = *fitted_curve(signal);
  Plot plot = deviation_plot(title_of(signal), "deviation" + in_brackets(signal.unit));
  plot.y_range = range_around(curve);
  for (std::size_t t = 0; t < kTerms; ++t) {
    if (signal.terms.term[t].resolved) add_term(plot, signal, static_cast<Term>(t), curve.tau_s);
  }
  plot.series.push_back(band("68 %", curve, 0));
  plot.series.push_back(line("measured", curve.tau_s, curve.value, 0));
  plot.series.push_back(line("terms together", curve.tau_s, fitted(signal, curve.tau_s), 1));
  plot.series.back().dashed = true;
  return plot;
}

Plot residual_plot(const SignalAnalysis& signal) {
  const AllanCurve& curve = *fitted_curve(signal);
  const std::vector<double> model = fitted(signal, curve.tau_s);
  const auto relative = [&](const std::vector<double>& values) {
    std::vector<double> percent;
    for (std::size_t i = 0; i < values.size(); ++i) percent.push_back(100.0 * (values[i] / model[i] - 1.0));
    return percent;
  };
  Plot plot = deviation_plot("Left over", "measured / fitted − 1 [%]");
  plot.log_y = false;
  Series interval = band("68 %", curve, 0);
  interval.lower = relative(curve.low);
  interval.upper = relative(curve.high);
  const std::vector<double> measured = relative(curve.value);
  plot.y_range = residual_range(measured);
  plot.series = {line("", {curve.tau_s.front(), curve.tau_s.back()}, {0.0, 0.0}, kGuideColour), interval,
                 line("measured", curve.tau_s, measured, 0)};
  return plot;
}

Plot imu_utils_plot(const SignalAnalysis& signal, double rate_hz) {
  const ImuUtilsNumbers& numbers = signal.imu_utils;
  Plot plot = deviation_plot(title_of(signal), "deviation" + in_brackets(signal.unit));
  if (const AllanCurve* curve = fitted_curve(signal)) {
    plot.series.push_back(line("measured", curve->tau_s, curve->value, 0));
  }
  plot.series.push_back(line("imu_utils: measured", numbers.tau_s, numbers.measured, 4));
  plot.series.push_back(line("its fit", numbers.tau_s, numbers.fitted, 1));
  plot.series.back().dashed = true;
  const std::string name = signal.sensor == "gyroscope" ? "gyr" : signal.sensor == "accelerometer" ? "acc" : "series";
  plot.annotations.push_back({1.0 / rate_hz, numbers.n, joined({name, "_n at τ = 1 / rate"})});
  plot.annotations.push_back({numbers.w_tau_s, numbers.w, joined({name, "_w"})});
  for (const Annotation& note : plot.annotations) {
    Series mark = line("", {note.x}, {note.y}, 6);
    mark.style = SeriesStyle::kPoints;
    plot.series.push_back(mark);
  }
  return plot;
}

}  // namespace vispline::report
