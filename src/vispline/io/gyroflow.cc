#include "vispline/io/gyroflow.h"

#include <cmath>
#include <string>

#include "vispline/io/format_words.h"
#include "vispline/io/number_text.h"

namespace vispline::gyroflow {
namespace {

constexpr double kStandardGravity = 9.80665;  // m/s^2 in one g, by definition

[[noreturn]] void fail_scale(const ReadContext& context, const char* key) {
  context.fail(ExitCode::kInput, "E-COLUMNS", std::string("no usable ") + key + " before the table", context.path(),
               "pass --columns with units for the columns, and --time-unit");
}

double scale_of(const ReadContext& context, const TextLayout& layout, const char* key) {
  double scale = 0.0;
  const auto note = layout.notes.find(key);
  const bool good = note != layout.notes.end() && parse_double(note->second, scale) == NumberStatus::kOk;
  if (!good || !std::isfinite(scale) || scale <= 0.0) fail_scale(context, key);
  return scale;
}

/// Ticks a second must be whole: 1 / tscale, to the precision that it is written with.
TimeUnit unit_of(const ReadContext& context, double tscale) {
  for (const char* name : {"s", "ms", "us", "ns"}) {
    const TimeUnit unit = *time_unit_named(name);
    if (std::abs(tscale * 1e9 / unit.nanoseconds() - 1.0) < 1e-9) return unit;
  }
  const double ticks = std::round(1.0 / tscale);
  if (!(ticks >= 1.0 && ticks <= 1e9) || std::abs(ticks * tscale - 1.0) > 1e-6) fail_scale(context, "tscale");
  return {.kind = TimeUnit::Kind::kIndex, .rate_numerator = static_cast<std::int64_t>(ticks), .rate_denominator = 1};
}

}  // namespace

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout) {
  if (layout.notes.empty()) return std::nullopt;
  ColumnPlan plan = plan_by_names(context, layout.header);
  plan.format = kName;
  plan.time_unit = unit_of(context, scale_of(context, layout, "tscale"));
  plan.gyro_unit = scale_of(context, layout, "gscale");
  if (plan.has(kAccelX, 3)) plan.accel_unit = scale_of(context, layout, "ascale") * kStandardGravity;
  return plan;
}

std::string text(const ImuSignal& imu, std::optional<double> readout_s) {
  std::string out = "GYROFLOW IMU LOG\nversion,1.3\nid,vispline\norientation,XYZ\n";
  if (readout_s) {
    out += "frame_readout_time,";
    append_number(out, *readout_s * 1e3);
    out += "\nframe_readout_direction,0\n";
  }
  out += "tscale,0.000000001\ngscale,1.0\nascale,";
  append_number(out, 1.0 / kStandardGravity);
  out += "\nt,gx,gy,gz,ax,ay,az\n";
  for (std::size_t i = 0; i < imu.size(); ++i) {
    append_number(out, to_ns(imu.time[i]));
    append_cells(out, ',', imu.value[i].gyro);
    append_cells(out, ',', imu.value[i].accel);
    out += '\n';
  }
  return out;
}

}  // namespace vispline::gyroflow
