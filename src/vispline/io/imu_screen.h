/// Every check that an IMU recording passes, whatever kind of file it comes from: rows in, kept samples out, in
/// constant memory. docs/formats.md, Diagnostics.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "vispline/io/imu_checks.h"
#include "vispline/io/stamp_rate.h"
#include "vispline/io/stamp_screen.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Consecutive samples, stamps strictly increasing over all calls, SI units. What it throws ends the reading.
using ImuSink = std::function<void(std::span<const Time>, std::span<const ImuSample>)>;

class ImuScreen {
 public:
  /// Axes that are not present are not looked at. At most four windows of rows are held.
  ImuScreen(ReadContext& context, ImuSink sink, const ImuAxes& axes = {}, std::size_t window = kWindowRows);

  /// The next row as the file has it, SI units; `ns` kNoStamp: it is no time of 64 bits. The caller has counted it in
  /// context.counts.read. `where`: its place in the file, for messages (line number); `scientific`: the stamp was
  /// written with an exponent.
  void push(std::int64_t ns, const ImuSample& sample, std::int64_t where, bool scientific = false);

  /// There are no more rows: the last samples go to the sink.
  void flush();

  /// After flush: the checks that need the whole recording. Sets context.counts.kept. Throws what StampScreen::judge
  /// and ImuCheck::judge throw, E-NONFINITE above 1 %, E-EMPTY if nothing is left; with options.strict the first
  /// warning.
  void finish(double unit_ns = 1.0);

  const StampScreen& stamps() const { return stamps_; }
  /// The most rows that were held at a time.
  std::size_t largest_window() const { return stamps_.largest_window() + largest_; }

 private:
  void take(std::span<const SensorRow> rows);
  bool is_finite(const SensorRow& row) const;
  void release(bool last);
  void hand_on_without_spikes(std::size_t stop);
  void hand_on(std::size_t begin, std::size_t end);
  void judge_nonfinite() const;

  ReadContext& context_;
  ImuSink sink_;
  ImuAxes axes_;
  std::vector<Time> time_;  ///< the first done_ are only there as neighbours
  std::vector<ImuSample> sample_;
  std::vector<std::int64_t> where_;
  std::size_t done_ = 0;
  std::size_t largest_ = 0;
  std::int64_t nonfinite_ = 0, first_nonfinite_ = 0;
  StampScreen stamps_;
  ImuCheck imu_;
  RateCheck rate_;
};

}  // namespace vispline
