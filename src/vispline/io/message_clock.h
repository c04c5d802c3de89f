/// The stamps of recorded messages: those of their headers or the times of their arrival, never mixed, and how far
/// apart the two are. docs/formats.md, Recordings.
#pragma once

#include <optional>

#include "vispline/bags/bag.h"
#include "vispline/bags/ros_messages.h"
#include "vispline/io/even_sample.h"
#include "vispline/io/read_context.h"

namespace vispline {

/// Stamp of the header minus time of arrival, ns: what 5 %, 50 % and 95 % of the messages stay below.
struct StampDelay {
  std::int64_t low = 0, median = 0, high = 0;
};

class MessageClock {
 public:
  explicit MessageClock(ReadContext& context) : context_(context) {}

  /// ns; kNoStamp if the chosen one is none: nanoseconds from 1e9, negative seconds.
  std::int64_t stamp(const ros::Header& header, std::int64_t receive_ns);

  /// Of the messages whose header has a stamp other than zero.
  std::optional<StampDelay> delay() const;

  /// After the last message. W-STAMP for headers without a stamp, or far from the time of arrival (a median of more
  /// than 10 ms).
  void judge() const;

 private:
  ReadContext& context_;
  std::int64_t messages_ = 0, zero_ = 0;
  EvenSample<std::int64_t> delays_;
};

}  // namespace vispline
