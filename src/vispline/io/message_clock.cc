#include "vispline/io/message_clock.h"

#include <cstdlib>
#include <string>

#include "vispline/io/number_text.h"
#include "vispline/io/text_row.h"

namespace vispline {
namespace {

constexpr std::int64_t kFar = 10'000'000;  // 10 ms

std::string span_text(std::int64_t ns) {
  const double seconds = static_cast<double>(ns) * 1e-9;
  return std::abs(seconds) < 1.0 ? brief(1e3 * seconds) + " ms" : brief_seconds(seconds);
}

}  // namespace

std::int64_t MessageClock::stamp(const ros::Header& header, std::int64_t receive_ns) {
  ++messages_;
  zero_ += header.stamp_ns == 0;
  std::int64_t delay = 0;
  const bool differ = !__builtin_sub_overflow(header.stamp_ns, receive_ns, &delay);
  if (header.stamp_valid && header.stamp_ns != 0 && differ) delays_.add(delay);
  if (context_.options().clock == StampClock::kReceive) return receive_ns;
  return header.stamp_valid ? header.stamp_ns : kNoStamp;
}

std::optional<StampDelay> MessageClock::delay() const {
  if (delays_.empty()) return std::nullopt;
  const auto at = [&](double part) { return quantile(delays_.values(), part); };
  return StampDelay{at(0.05), at(0.5), at(0.95)};
}

void MessageClock::judge() const {
  const bool receive = context_.options().clock == StampClock::kReceive;
  const std::string effect = receive ? "the times of arrival are used" : "the stamps of the headers are used";
  const std::string next = receive ? "" : "pass --time receive to use the times of arrival instead";
  if (zero_ > 0) {
    context_.warn(
        "W-STAMP",
        std::to_string(zero_) + " of " + std::to_string(messages_) + " messages have a header without a stamp",
        context_.path(), effect, next);
  }
  const auto far = delay();
  if (!far || std::abs(static_cast<double>(far->median)) <= kFar) return;
  context_.warn("W-STAMP",
                "the stamps of the headers are " + span_text(far->median) + " from the times of arrival (" +
                    span_text(far->low) + " to " + span_text(far->high) + " for nine of ten)",
                context_.path(), effect, next);
}

}  // namespace vispline
