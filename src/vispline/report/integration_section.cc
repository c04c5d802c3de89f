#include "vispline/report/integration_section.h"

#include <map>

namespace vispline::report {
namespace {

/// Whole rates without decimals.
Cell rate_cell(double rate_hz) {
  const auto whole = static_cast<std::int64_t>(rate_hz);
  return static_cast<double>(whole) == rate_hz ? Cell(whole) : Cell(rate_hz);
}

Table table_of(const std::vector<IntegrationRow>& rows) {
  Table table{.caption = "Error of dead reckoning against the truth; order from the largest errors at two rates",
              .columns = {{.header = "method", .unit = "", .numeric = false},
                          {.header = "rate", .unit = "Hz"},
                          {.header = "final error", .unit = "m"},
                          {.header = "largest error", .unit = "m"},
                          {.header = "rms error", .unit = "m"},
                          {.header = "attitude error", .unit = "deg"},
                          {.header = "order", .unit = "", .numeric = true, .digits = 3}},
              .rows = {}};
  for (const IntegrationRow& row : rows) {
    const DeadReckoningError& e = row.error;
    table.rows.push_back({row.method, rate_cell(row.rate_hz), e.final_error_m, e.max_error_m, e.rmse_m,
                          e.attitude_error_deg, row.order ? Cell(*row.order) : Cell(std::string())});
  }
  return table;
}

Plot convergence_plot(const std::vector<IntegrationRow>& rows) {
  Plot plot{.title = "Convergence", .x_label = "IMU rate [Hz]", .y_label = "largest position error [m]"};
  plot.log_x = plot.log_y = true;
  std::map<std::string, std::size_t> index;
  for (const IntegrationRow& row : rows) {
    const auto [entry, added] = index.try_emplace(row.method, plot.series.size());
    if (added) {
      Series series{.name = row.method, .style = SeriesStyle::kLineAndPoints};
      series.colour = static_cast<int>(entry->second % 8);
      series.dashed = entry->second >= 8;
      plot.series.push_back(series);
    }
    plot.series[entry->second].x.push_back(row.rate_hz);
    plot.series[entry->second].y.push_back(row.error.max_error_m);
  }
  plot.height_px = 380.0;
  return plot;
}

}  // namespace

Section integration_section(const std::string& heading, const std::string& text,
                            const std::vector<IntegrationRow>& rows) {
  return {heading,
          {Paragraph{text},
           Figure{{convergence_plot(rows)},
                  "A rule of order p gains p decades of accuracy for one decade of rate. Lines that coincide differ "
                  "only in terms too small to see."},
           table_of(rows)}};
}

}  // namespace vispline::report
