/// Where the chunks of a rosbag stand, and what its index says about them. Chunk contents are not looked at.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "vispline/bags/rosbag_records.h"

namespace vispline::rosbag {

using Counts = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // connection, messages; sorted

struct ChunkPlace {
  std::uint64_t offset = 0, data_offset = 0, stored = 0;  ///< `stored` bytes are there
  std::uint64_t size = 0;                                 ///< uncompressed, as it claims
  std::string compression = {};
  bool cut = false;                                        ///< the file ends in it
  Counts counts = {};                                      ///< from the index records behind it
  std::optional<std::int64_t> begin_ns = {}, end_ns = {};  ///< from its chunk info
};

/// A part of the file between chunks in which no record stands.
struct Hole {
  std::uint64_t offset = 0, bytes = 0;
  std::optional<std::int64_t> begin_ns = {}, end_ns = {};
};

struct Layout {
  std::vector<ChunkPlace> chunks;                            ///< in the order of the file
  std::vector<std::pair<std::uint32_t, Topic>> connections;  ///< from the index section
  std::vector<Hole> holes;
  bool closed = false;          ///< the header says where the index is
  std::uint64_t index_pos = 0;  ///< as the header says
  std::uint64_t lost_tail = 0;  ///< bytes of an unfinished record at the end
  std::uint64_t surplus = 0;    ///< bytes behind an index that is whole
  std::string disagreement;     ///< of the index and the data; empty if there is none
};

/// Throws E-UNSUPPORTED for other versions and encryption, E-CORRUPT for what is no rosbag behind its first line or,
/// unless `repair`, for damage that no index helps over, E-LIMIT.
Layout find_layout(const Input& input, bool repair);

}  // namespace vispline::rosbag
