#include <numbers>

#include "vispline/results/documents.h"
#include "vispline/results/table.h"

namespace vispline {
namespace {

constexpr int kDigits = 5;
constexpr int kTimeDigits = 7;

void add_axes(Table& table, const char* name, const std::array<AxisComparison, 3>& axes, const char* unit) {
  for (std::size_t i = 0; i < 3; ++i) {
    const AxisComparison& axis = axes[i];
    table.add_row({name, std::string(1, "xyz"[i]), number_text(axis.rms, kDigits), number_text(axis.mean, kDigits),
                   number_text(axis.std, kDigits), unit, number_text(axis.correlation, kDigits)});
  }
}

}  // namespace

std::string integrate_text(const std::vector<IntegrationRow>& rows) {
  Table table({{"method", Table::Align::kLeft},
               {"rate [Hz]"},
               {"final [m]"},
               {"max [m]"},
               {"rmse [m]"},
               {"attitude [deg]"},
               {"order"}});
  for (const IntegrationRow& row : rows) {
    table.add_row({row.method, number_text(row.rate_hz, kDigits), number_text(row.error.final_error_m, kDigits),
                   number_text(row.error.max_error_m, kDigits), number_text(row.error.rmse_m, kDigits),
                   number_text(row.error.attitude_error_deg, kDigits), number_text(row.order, 3)});
  }
  return table.text();
}

std::string evaluate_imu_text(const ImuComparison& c) {
  const double rotation_deg = c.rotation_vector.norm() * 180.0 / std::numbers::pi;
  std::string text =
      "time offset   " + number_text(c.time_offset_s, kTimeDigits) + " s (add to the first file's stamps)\n";
  text += "rotation      " + number_text(rotation_deg, kDigits) + " deg (first file's frame to second's)\n";
  text += "correlation   " + number_text(c.offset_correlation, kDigits) + " of |angular rate|, confidence " +
          number_text(c.offset_confidence, 3) + "\n";
  text += "compared      " + std::to_string(c.compared) + " samples of the second file, " + std::to_string(c.outside) +
          " outside the first, " + std::to_string(c.in_gaps) + " in its gaps\n\n";
  Table table({{"sensor", Table::Align::kLeft},
               {"axis", Table::Align::kLeft},
               {"rms"},
               {"mean"},
               {"std"},
               {"unit", Table::Align::kLeft},
               {"correlation"}});
  add_axes(table, "gyroscope", c.gyroscope, "rad/s");
  add_axes(table, "accelerometer", c.accelerometer, "m/s^2");
  return text + table.text();
}

std::string evaluate_trajectory_text(const TrajectoryComparison& c) {
  std::string text = "alignment     " + std::string(to_name(c.alignment_mode)) + ", scale " +
                     number_text(c.alignment.scale, kTimeDigits) + "\n";
  text += "compared      " + std::to_string(c.association.pairs.size()) + " poses over " +
          number_text(c.duration_s, kDigits) + " s and " + number_text(c.path_length_m, kDigits) + " m, " +
          std::to_string(c.association.estimate_outside) + " outside, " +
          std::to_string(c.association.estimate_unmatched) + " unmatched\n\n";
  Table absolute({{"ATE", Table::Align::kLeft}, {"rmse"}, {"mean"}, {"median"}, {"max"}, {"std"}});
  const ErrorStatistics& s = c.position_m;
  absolute.add_row({"position [m]", number_text(s.rmse, kDigits), number_text(s.mean, kDigits),
                    number_text(s.median, kDigits), number_text(s.max, kDigits), number_text(s.std, kDigits)});
  absolute.add_row({"attitude [deg]", number_text(c.rotation_rmse_deg, kDigits), "-", "-",
                    number_text(c.rotation_max_deg, kDigits), "-"});
  Table relative({{"RPE over", Table::Align::kLeft}, {"pairs"}, {"translation rmse [m]"}, {"rotation rmse [deg]"}});
  for (const RelativeError& error : c.relative) {
    const char* unit = error.delta.unit == DeltaUnit::kSeconds ? " s" : " m";
    relative.add_row({number_text(error.delta.value, kDigits) + unit, std::to_string(error.pairs),
                      number_text(error.translation_rmse_m, kDigits), number_text(error.rotation_rmse_deg, kDigits)});
  }
  text += absolute.text();
  if (!c.relative.empty()) text.append("\n").append(relative.text());
  return text;
}

}  // namespace vispline
