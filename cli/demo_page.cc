#include "demo_page.h"

#include <cmath>

#include "vispline/report/allan_section.h"
#include "vispline/report/integration_section.h"

namespace vispline::cli {
namespace {

using namespace report;

std::vector<double> seconds_of(const std::vector<Time>& time) {
  std::vector<double> seconds;
  for (const Time t : time) seconds.push_back(to_seconds(t - time.front()));
  return seconds;
}

Series line(const std::string& name, std::vector<double> x, std::vector<double> y, int colour) {
  Series series{.name = name, .x = std::move(x), .y = std::move(y)};
  series.colour = colour;
  return series;
}

/// One line per axis of a vector of each sample.
template <class Values, class Get>
Plot vector_plot(const std::string& title, const std::string& y_label, const std::vector<double>& seconds,
                 const Values& values, Get get) {
  Plot plot{.title = title, .x_label = "time [s]", .y_label = y_label};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> y;
    for (const auto& value : values) y.push_back(get(value)(axis));
    plot.series.push_back(line(std::string(1, "xyz"[axis]), seconds, std::move(y), axis));
  }
  return plot;
}

Section motion_section(const DemoResult& demo) {
  const auto& states = demo.samples.body.value;
  const auto seconds = seconds_of(demo.samples.body.time);
  std::vector<double> x, y, z;
  for (const BodyState& state : states) {
    x.push_back(state.p_w.x());
    y.push_back(state.p_w.y());
    z.push_back(state.p_w.z());
  }
  Plot top{.title = "Seen from above", .x_label = "x [m]", .y_label = "y [m]", .series = {line("", x, y, 0)}};
  top.equal_aspect = true;
  top.width_px = 400.0;
  Plot height{.title = "Height", .x_label = "time [s]", .y_label = "z [m]", .series = {line("", seconds, z, 0)}};
  height.width_px = 400.0;
  return {"The motion",
          {Paragraph{"The trajectory is the formula '" + demo.trajectory +
                     "', exact in every derivative: position, velocity and acceleration in the world, attitude, rate "
                     "and angular acceleration of the body."},
           Figure{{top, height}, "True position of the body in the world, z up."}}};
}

Section imu_section(const DemoResult& demo) {
  const auto seconds = seconds_of(demo.samples.measured.time);
  const auto& values = demo.samples.measured.value;
  const NoiseModel &gyro = demo.simulation.imu.noise.gyro, &accel = demo.simulation.imu.noise.accel;
  report::Table noise{
      .caption = "Noise of the simulated IMU, continuous-time",
      .columns = {{.header = "instrument", .numeric = false},
                  {.header = "white density"},
                  {.header = "bias random walk"},
                  {.header = "unit", .numeric = false}},
      .rows = {{std::string("gyroscope"), gyro.white, gyro.walk, std::string("rad/s/√Hz, rad/s²/√Hz")},
               {std::string("accelerometer"), accel.white, accel.walk, std::string("m/s²/√Hz, m/s³/√Hz")}}};
  return {"The instrument",
          {Paragraph{"What an IMU on the body writes down. Gravity points down, so the accelerometer reads +9.81 "
                     "m/s² on the vertical axis when at rest."},
           Figure{{vector_plot("Gyroscope", "angular rate [rad/s]", seconds, values,
                               [](const ImuSample& s) { return s.gyro; })},
                  ""},
           Figure{{vector_plot("Accelerometer", "specific force [m/s²]", seconds, values,
                               [](const ImuSample& s) { return s.accel; })},
                  ""},
           noise}};
}

Plot error_plot(const std::string& title, const std::vector<ErrorCurve>& curves) {
  Plot plot{.title = title, .x_label = "time [s]", .y_label = "position error [m]"};
  plot.log_y = true;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    plot.series.push_back(line(curves[i].method, curves[i].time_s, curves[i].error_m, static_cast<int>(i)));
  }
  return plot;
}

Section noise_section(const DemoResult& demo) {
  Plot noisy = error_plot("With noise", demo.noisy);
  const double N = demo.simulation.imu.noise.gyro.white, g = demo.simulation.g_w.norm();
  Series theory{.name = "g N √(t⁵/20)"};
  for (const double t : demo.noisy.front().time_s) {
    theory.x.push_back(t);
    theory.y.push_back(g * N * std::sqrt(std::pow(t, 5) / 20.0));
  }
  theory.colour = kGuideColour;
  theory.dashed = true;
  noisy.series.push_back(theory);
  return {
      "What integration costs, and what noise costs",
      {Paragraph{"Without noise the rules differ by orders of magnitude. With the noise of a small MEMS sensor they "
                 "hardly differ: the white noise of the gyroscope tilts the estimate, and gravity leaks into the "
                 "horizontal acceleration. The dashed line is the standard deviation that this predicts for each "
                 "horizontal axis."},
       Figure{{error_plot("Without noise", demo.exact)}, "Error of dead reckoning over time, 200 Hz."},
       Figure{{noisy}, "The same rules on the noisy samples."}}};
}

}  // namespace

report::Page demo_page(const DemoResult& demo, const DemoLoop& loop, const report::Provenance& provenance) {
  Page page{.title = "vispline demo",
            .subtitle =
                "A phone is simulated, its noise identified, its rig calibrated from a poor start, and dead "
                "reckoning done by every rule: the truth stands beside every number",
            .provenance = provenance};
  Cards cards;
  for (const IntegrationRow& row : demo.exact_rows) {
    const bool shown = row.method == "euler_course" || row.method == "midpoint" || row.method == "rk4_cubic";
    if (shown && row.rate_hz == demo.simulation.imu.rate_hz) {
      cards.cards.push_back({row.error.final_error_m, "m", "final error of " + row.method + ", noise-free, 200 Hz"});
    }
  }
  cards.cards.push_back(
      {demo.noisy.back().error_m.back(), "m", "final error of " + demo.noisy.back().method + " with noise"});
  for (report::Section& section : calibration_sections(loop.calibration, loop.course)) {
    page.sections.push_back(std::move(section));
  }
  for (report::Section& section : allan_sections(loop.noise)) {
    section.heading = "At rest: " + section.heading;
    page.sections.push_back(std::move(section));
  }
  page.sections.push_back({"Dead reckoning in short", {cards}});
  page.sections.push_back(motion_section(demo));
  page.sections.push_back(imu_section(demo));
  page.sections.push_back(noise_section(demo));
  page.sections.push_back(integration_section(
      "Every rule at every rate",
      "Noise-free samples at both ends of each step. The names say what each rule is; the two course rules and the "
      "course report's midpoint are reproduced with their defects.",
      demo.exact_rows));
  return page;
}

}  // namespace vispline::cli
