/// A gyroscope and an accelerometer that were recorded apart, as one IMU: samples at the stamps of the gyroscope, with
/// the specific force interpolated linearly between its neighbours. Memory does not grow with the recording.
#pragma once

#include <deque>
#include <functional>
#include <span>
#include <string>

#include "vispline/io/imu_screen.h"

namespace vispline {

/// Two streams of rows in order of time, put together.
class ImuPairing {
 public:
  /// `pair` gets the row of the gyroscope with the specific force in values[3..5]; `alone` the one that has no reading
  /// of the accelerometer on both sides, at most 0.1 s apart.
  ImuPairing(std::function<void(const SensorRow&)> pair, std::function<void(const SensorRow&)> alone)
      : pair_(std::move(pair)), alone_(std::move(alone)) {}

  /// values[0..2] are those of the sensor; stamps increase strictly over all calls. False: one stream is so far behind
  /// the other that too many rows would have to wait.
  bool push_gyro(std::span<const SensorRow> rows) { return push(gyro_, rows); }
  bool push_accel(std::span<const SensorRow> rows) { return push(accel_, rows); }
  /// There are no more rows.
  void finish();

 private:
  bool push(std::deque<SensorRow>& queue, std::span<const SensorRow> rows);
  bool settle_first(bool last);

  std::function<void(const SensorRow&)> pair_, alone_;
  std::deque<SensorRow> gyro_, accel_;
};

/// Rows of the two sensors in, checked samples of the IMU out.
class TriadStream {
 public:
  /// Counted are the rows of the gyroscope, in `gyro`; `accel` has the counts and warnings of the accelerometer, and
  /// finish() adds its warnings to those of `gyro`. A sensor without axes in `axes` is absent: the other is handed on
  /// alone, and counted in `gyro`. Throws E-COLUMNS (exit 3) for less than six axes if `whole_imu`.
  TriadStream(ReadContext& gyro, ReadContext& accel, const ImuSink& sink, const ImuAxes& axes, bool whole_imu,
              std::size_t window);

  /// The next row as the file has it, values[0..2] in SI units. Rows without a partner are dropped (W-UNPAIRED).
  /// E-LIMIT (exit 7): one sensor is a million rows behind the other.
  void push_gyro(const SensorRow& row);
  void push_accel(const SensorRow& row);

  /// There are no more rows. Throws what StampScreen::judge does for each sensor and ImuScreen::finish for both, and
  /// E-TIME-CONSTANT, where `if_constant` says what to do.
  void finish(const std::string& if_constant);

  std::size_t largest_window() const { return screen_.largest_window(); }

 private:
  void must_fit(bool fits) const;

  ReadContext& gyro_context_;
  ReadContext& accel_context_;
  bool both_;
  ImuScreen screen_;
  ImuPairing pairing_;
  StampScreen gyro_, accel_;
};

}  // namespace vispline
