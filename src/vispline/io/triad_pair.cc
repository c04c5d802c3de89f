#include "vispline/io/triad_pair.h"

#include <cmath>

namespace vispline {
namespace {

constexpr std::int64_t kMaxApart = 100'000'000;             // 0.1 s between two readings of the accelerometer
constexpr std::size_t kMostWaiting = std::size_t{1} << 20;  ///< rows of one sensor that wait for the other

const Vector3d kAbsent = Vector3d::Constant(std::nan(""));

Vector3d triad(const SensorRow& row, std::size_t first) {
  return {row.values[first], row.values[first + 1], row.values[first + 2]};
}

/// Specific force at the stamp of `gyro` in the straight line between two readings.
SensorRow between(SensorRow gyro, const SensorRow& a, const SensorRow& b) {
  const double part = b.ns == a.ns ? 0.0 : static_cast<double>(gyro.ns - a.ns) / static_cast<double>(b.ns - a.ns);
  for (std::size_t i = 0; i < 3; ++i) gyro.values[3 + i] = a.values[i] + part * (b.values[i] - a.values[i]);
  return gyro;
}

void require_whole(const ReadContext& context, const ImuAxes& axes) {
  if (axes.whole_gyro() && axes.whole_accel()) return;
  context.fail(ExitCode::kInput, "E-COLUMNS",
               std::string("no IMU samples: the recording holds ") +
                   (axes.has_gyro() ? "a gyroscope and no accelerometer" : "an accelerometer and no gyroscope"),
               context.path(), "give a recording with both");
}

void judge_stamps(const ReadContext& context, StampScreen& screen, const std::string& if_constant) {
  if (screen.rows_in_range() > 1 && screen.rows_kept() == 1) {
    context.fail(ExitCode::kInput, "E-TIME-CONSTANT",
                 "all " + std::to_string(screen.rows_in_range()) + " stamps are equal", context.path(), if_constant);
  }
  screen.judge(1.0);
}

}  // namespace

bool ImuPairing::push(std::deque<SensorRow>& queue, std::span<const SensorRow> rows) {
  queue.insert(queue.end(), rows.begin(), rows.end());
  while (!gyro_.empty() && settle_first(false)) gyro_.pop_front();
  return gyro_.size() <= kMostWaiting && accel_.size() <= kMostWaiting;
}

void ImuPairing::finish() {
  while (!gyro_.empty() && settle_first(true)) gyro_.pop_front();
}

/// False: the reading of the accelerometer behind it has not come yet.
bool ImuPairing::settle_first(bool last) {
  const SensorRow& gyro = gyro_.front();
  while (accel_.size() >= 2 && accel_[1].ns <= gyro.ns) accel_.pop_front();
  const bool starts_before = !accel_.empty() && accel_[0].ns <= gyro.ns;
  if (starts_before && accel_[0].ns == gyro.ns) return pair_(between(gyro, accel_[0], accel_[0])), true;
  if (starts_before && accel_.size() == 1 && !last) return false;
  if (accel_.empty() && !last) return false;
  const bool is_between = starts_before && accel_.size() >= 2 && accel_[1].ns - accel_[0].ns <= kMaxApart;
  if (is_between) {
    pair_(between(gyro, accel_[0], accel_[1]));
  } else {
    alone_(gyro);
  }
  return true;
}

TriadStream::TriadStream(ReadContext& gyro, ReadContext& accel, const ImuSink& sink, const ImuAxes& axes,
                         bool whole_imu, std::size_t window)
    : gyro_context_(gyro),
      accel_context_(accel),
      both_(axes.has_gyro() && axes.has_accel()),
      screen_(gyro, sink, axes, window),
      pairing_(
          [this](const SensorRow& row) {
            screen_.push(row.ns, {triad(row, 0), triad(row, 3)}, row.where);
          },
          [this](const SensorRow& row) {
            gyro_context_.drop("W-UNPAIRED", "no accelerometer within 0.1 s on both sides",
                               gyro_context_.where_line(row.where));
          }),
      gyro_(
          gyro, [this](std::span<const SensorRow> rows) { must_fit(pairing_.push_gyro(rows)); }, window),
      accel_(
          accel, [this](std::span<const SensorRow> rows) { must_fit(pairing_.push_accel(rows)); }, window) {
  if (whole_imu) require_whole(gyro, axes);
}

void TriadStream::push_gyro(const SensorRow& row) {
  ++gyro_context_.counts.read;
  if (both_) {
    gyro_.push(row);
  } else {
    screen_.push(row.ns, {triad(row, 0), kAbsent}, row.where);
  }
}

void TriadStream::push_accel(const SensorRow& row) {
  ++(both_ ? accel_context_ : gyro_context_).counts.read;
  if (both_) {
    accel_.push(row);
  } else {
    screen_.push(row.ns, {kAbsent, triad(row, 0)}, row.where);
  }
}

void TriadStream::finish(const std::string& if_constant) {
  gyro_.flush();
  accel_.flush();
  pairing_.finish();
  screen_.flush();
  if (both_) {
    judge_stamps(gyro_context_, gyro_, if_constant);
    judge_stamps(accel_context_, accel_, if_constant);
  }
  gyro_context_.diagnostics.merge(accel_context_.diagnostics);
  screen_.finish();
}

void TriadStream::must_fit(bool fits) const {
  if (fits) return;
  gyro_context_.fail(
      ExitCode::kLimit, "E-LIMIT",
      "gyroscope and accelerometer stand more than " + std::to_string(kMostWaiting) + " samples apart in the file",
      gyro_context_.path(), "put the recording in order of time");
}

}  // namespace vispline
