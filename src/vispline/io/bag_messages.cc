#include "vispline/io/bag_messages.h"

#include <utility>

namespace vispline {
namespace {

void refuse_table_flags(const ReadContext& context) {
  const ReadOptions& options = context.options();
  const std::string flag = !options.format.empty()      ? "--input-format"
                           : !options.columns.empty()   ? "--columns"
                           : !options.time_unit.empty() ? "--time-unit"
                           : options.rate_hz != 0.0     ? "--rate"
                                                        : "";
  if (flag.empty()) return;
  throw Error(ExitCode::kUsage, {.code = "E-ARGUMENT",
                                 .message = flag + " is for text tables, " + vispline::quoted(context.path()) +
                                            " is a recording of messages",
                                 .where = flag,
                                 .effect = "nothing read",
                                 .next = "leave it out, or pass auto in its place for this input"});
}

/// Counts and warnings of the reader join those of the context.
void take_over(ReadContext& context, const BagReader& reader) {
  for (const auto& [code, count] : reader.counts().dropped) {
    context.counts.dropped[code] += count;
    context.counts.read += count;
  }
  context.diagnostics.merge(reader.diagnostics());
}

}  // namespace

std::unique_ptr<BagReader> open_recording(const ReadContext& context, const ReadProgress& progress) {
  refuse_table_flags(context);
  BagOptions options{.repair = context.options().repair};
  if (progress) {
    options.progress = [progress](std::uint64_t done, std::uint64_t total) {
      progress(done, total);
      return true;
    };
  }
  return open_bag(context.path(), options);
}

void read_messages(ReadContext& context, BagReader& reader, const std::vector<bool>& wanted, const MessageTaker& take) {
  const std::vector<Topic>& topics = reader.topics();
  std::int64_t refused = 0;
  const auto is_wanted = [&](const Topic& topic) {
    return bool{wanted[static_cast<std::size_t>(&topic - &topics[0])]};
  };
  reader.read(is_wanted, [&](const Message& message) {
    const Topic& topic = topics[message.topic];
    ++context.counts.read;
    if (take(topic, message)) return true;
    ++refused;
    context.drop("W-MESSAGE",
                 "a message of " + std::to_string(message.data.size()) + " bytes is no " + vispline::quoted(topic.type),
                 context.where_line(context.counts.read));
    return true;
  });
  take_over(context, reader);
  if (!context.too_many(refused)) return;
  context.fail(ExitCode::kInput, "E-MESSAGE", percent(context.share(refused)) + " of the messages cannot be decoded",
               context.path(), "get the recording again, or pass --repair to leave them out");
}

std::string other_clock(const ReadContext& context) {
  return context.options().clock == StampClock::kHeader ? "pass --time receive to use the times of arrival"
                                                        : "pass --time header to use the stamps of the headers";
}

void check_constant_time(const ReadContext& context, std::int64_t rows, std::int64_t distinct) {
  if (rows < 2 || distinct != 1) return;
  context.fail(ExitCode::kInput, "E-TIME-CONSTANT", "all " + std::to_string(rows) + " stamps are equal", context.path(),
               other_clock(context));
}

}  // namespace vispline
