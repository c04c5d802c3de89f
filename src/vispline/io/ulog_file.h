/// ULog, the log of PX4: definitions of messages, subscriptions, data. Little-endian.
/// https://docs.px4.io/main/en/dev_log/ulog_file_format
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vispline/bags/input.h"
#include "vispline/io/text_lines.h"

namespace vispline::ulog {

inline constexpr std::size_t kHeaderBytes = 16;

/// Where a number stands in a message, from the text of its definition.
struct Field {
  std::string type{};  ///< "float"
  std::size_t offset = 0;
  std::size_t count = 1;  ///< of an array
};

/// A topic that is logged.
struct Subscription {
  std::string name{};  ///< "sensor_combined"
  int instance = 0;
  std::int64_t messages = 0;
  std::map<std::string, Field> fields{};  ///< up to the first whose type is no plain number
};

/// What happened on the way through a file.
struct Walked {
  bool truncated = false;           ///< the last message is cut
  std::uint64_t corrupt_bytes = 0;  ///< passed over to the next synchronisation mark, or to the end
};

using Subscriptions = std::map<std::uint16_t, Subscription>;
/// A data message: its subscription, its bytes after the id, and where it starts.
using OnData = std::function<void(const Subscription&, Bytes, std::uint64_t offset)>;

/// Reads from front to end through one window. Throws E-FORMAT (exit 3) if it is no ULog, E-UNSUPPORTED for a flag of
/// incompatibility that is not known, E-LIMIT (exit 7) for more than 4096 definitions.
Walked walk(const Input& input, Subscriptions& subscriptions, const OnData& on_data, const ReadProgress& progress = {});

/// Element `index` of a field; empty if the message is too short or has no such field.
std::optional<double> number(const Subscription& topic, Bytes message, const std::string& field, std::size_t index = 0);
/// The same for an unsigned or signed integer of 64 bits, exact.
std::optional<std::int64_t> integer(const Subscription& topic, Bytes message, const std::string& field);

}  // namespace vispline::ulog
