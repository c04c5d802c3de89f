/// The messages of chosen topics of a recording, each counted and accounted for.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vispline/bags/open_bag.h"
#include "vispline/io/read_context.h"
#include "vispline/io/text_lines.h"

namespace vispline {

/// Opens the recording of `context`. Throws as open_bag does, and E-ARGUMENT (exit 2) for flags that only a text table
/// has.
std::unique_ptr<BagReader> open_recording(const ReadContext& context, const ReadProgress& progress = {});

/// False: the message cannot be decoded.
using MessageTaker = std::function<bool(const Topic&, const Message&)>;

/// Every message of the topics that are `wanted` goes to `take`, counted in context.counts.read; those that it refuses
/// are dropped with W-MESSAGE, more than 1 % of them are E-MESSAGE (exit 3). Warnings and losses of the reader end in
/// the context.
void read_messages(ReadContext& context, BagReader& reader, const std::vector<bool>& wanted, const MessageTaker& take);

/// The flag that takes the other clock: what to do if that of the options stands still.
std::string other_clock(const ReadContext& context);

/// E-TIME-CONSTANT (exit 3) if `rows` stamps are one: all headers were left at zero, as a rule.
void check_constant_time(const ReadContext& context, std::int64_t rows, std::int64_t distinct);

}  // namespace vispline
