#include "vispline/io/triad_pair.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vispline {
namespace {

Vector3d vector_of(const SensorRow& row) { return {row.values[0], row.values[1], row.values[2]}; }

const Vector3d kAbsent = Vector3d::Constant(std::nan(""));

/// `next` is the first row not before `ns`. Empty outside the span.
std::optional<Vector3d> interpolate(const std::vector<SensorRow>& rows, std::size_t next, std::int64_t ns) {
  if (next == rows.size()) return std::nullopt;
  if (rows[next].ns == ns) return vector_of(rows[next]);
  if (next == 0) return std::nullopt;
  const double step = static_cast<double>(rows[next].ns - rows[next - 1].ns);
  const double part = static_cast<double>(ns - rows[next - 1].ns) / step;
  return (1.0 - part) * vector_of(rows[next - 1]) + part * vector_of(rows[next]);
}

}  // namespace

void push_paired(ReadContext& context, const std::vector<SensorRow>& gyro, const std::vector<SensorRow>& accel,
                 ImuScreen& screen) {
  const bool alone = gyro.empty() || accel.empty();
  context.counts.read += static_cast<std::int64_t>(gyro.empty() ? accel.size() : gyro.size());
  if (alone) {
    for (const SensorRow& row : gyro) screen.push(row.ns, {vector_of(row), kAbsent}, row.where);
    for (const SensorRow& row : accel) screen.push(row.ns, {kAbsent, vector_of(row)}, row.where);
    return;
  }
  std::size_t next = 0;
  for (const SensorRow& row : gyro) {
    while (next > 0 && accel[next - 1].ns >= row.ns) --next;
    while (next < accel.size() && accel[next].ns < row.ns) ++next;
    if (const auto value = interpolate(accel, next, row.ns)) {
      screen.push(row.ns, {vector_of(row), *value}, row.where);
    } else {
      context.drop("W-UNPAIRED", "no accelerometer around this gyroscope sample", context.where_line(row.where));
    }
  }
}

void require_imu(const ReadContext& context, const ImuAxes& axes, bool whole) {
  if (!whole || (axes.whole_gyro() && axes.whole_accel())) return;
  context.fail(ExitCode::kInput, "E-COLUMNS",
               std::string("no IMU samples: the recording holds ") +
                   (axes.has_gyro() ? "a gyroscope and no accelerometer" : "an accelerometer and no gyroscope"),
               context.path(), "give a recording with both");
}

void require_below(const ReadContext& context, std::size_t held, const std::string& what) {
  constexpr std::size_t kMost = 64'000'000;
  if (held <= kMost) return;
  context.fail(ExitCode::kLimit, "E-LIMIT", "more than 64 million " + what, context.path(), "cut the recording");
}

}  // namespace vispline
