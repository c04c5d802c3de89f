/// Which topic a channel of an MCAP file is.
#pragma once

#include <unordered_map>
#include <vector>

#include "vispline/bags/mcap_records.h"

namespace vispline::mcap {

class TopicTable {
 public:
  /// The first schema of an id counts.
  void add(const Schema& schema) { schemas_.try_emplace(schema.id, schema); }
  /// Appends the topic of a channel that is not known yet to `topics`. False: no record describes its schema.
  bool add(const Channel& channel, std::vector<Topic>& topics);

  /// Index of the topic; empty: no record describes the channel.
  std::optional<std::size_t> find(std::uint16_t channel) const;

 private:
  std::unordered_map<std::uint16_t, Schema> schemas_;
  std::unordered_map<std::uint16_t, std::size_t> channels_;
};

}  // namespace vispline::mcap
