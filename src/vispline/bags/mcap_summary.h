/// The summary at the end of a closed MCAP file.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "vispline/bags/mcap_records.h"

namespace vispline::mcap {

struct Summary {
  bool found = false;          ///< footer and summary are there and whole
  std::string wrong;           ///< why a summary that is there cannot be used; empty if it can, or if there is none
  std::uint64_t data_end = 0;  ///< one past the data section
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::map<std::uint16_t, std::uint64_t> counts;  ///< messages of each channel, from the statistics
  std::optional<std::uint64_t> messages;          ///< in all, from the statistics
  /// Channels with messages in the chunk record at an offset; only chunks whose index says so.
  std::map<std::uint64_t, std::set<std::uint16_t>> chunk_channels;
};

/// Never throws for damage: a summary that is not whole, or whose CRC differs, is not used.
Summary read_summary(const Input& input);

}  // namespace vispline::mcap
