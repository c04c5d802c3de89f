/// A gyroscope and an accelerometer on two topics of one recording: samples at the stamps of the gyroscope, with the
/// specific force interpolated linearly between its neighbours. docs/formats.md, Recordings.
#pragma once

#include <deque>
#include <functional>
#include <span>
#include <string>

#include "vispline/io/imu_stream.h"

namespace vispline {

/// As stream_imu_bag, from options.gyro_topic and options.accel_topic. Counted are the messages of the gyroscope;
/// samples that have no accelerometer within 0.1 s on both sides are dropped (W-UNPAIRED).
ImuStreamResult stream_imu_pair(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                                const ImuStreamSettings& settings);

/// Two streams of rows in order of time, put together.
class ImuPairing {
 public:
  /// `pair` gets the row of the gyroscope with the specific force in values[3..5]; `alone` the one that has no partner.
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

}  // namespace vispline
