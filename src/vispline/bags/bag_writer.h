/// Recordings of messages to files that the usual tools open. docs/bags.md.
#pragma once

#include <memory>
#include <string>

#include "vispline/bags/bag.h"
#include "vispline/bags/chunk_codec.h"
#include "vispline/files/output_file.h"

namespace vispline {

enum class Container { kRosbag, kMcap, kRosbag2 };

struct BagWriterOptions {
  Codec compression = Codec::kNone;      ///< rosbag: none, bz2, lz4; MCAP: none, lz4, zstd; rosbag2: none
  std::size_t chunk_bytes = 768 * 1024;  ///< a chunk is closed once it holds this many
  bool force = false;                    ///< replace an existing regular file
};

/// One recording being written; nothing has its final name before publish(). Throws E-OUTPUT (exit 6).
class BagWriter {
 public:
  virtual ~BagWriter() = default;
  BagWriter() = default;
  BagWriter(const BagWriter&) = delete;
  BagWriter& operator=(const BagWriter&) = delete;

  /// `wire`, `type`, `md5` and `definition` must be what they are; `count` and `encoding` are not looked at. Returns
  /// the number for write(). Throws E-ARGUMENT for a wire the container has no place for: a rosbag holds kRos1, rosbag2
  /// kCdr, MCAP both.
  virtual std::size_t add_topic(const Topic& topic) = 0;
  /// In any order of time; read back in the order of the calls. `receive_ns` from 0; a rosbag ends in 2106.
  virtual void write(std::size_t topic, std::int64_t receive_ns, Bytes data) = 0;
  /// Completes the file and gives it its name.
  virtual void publish() = 0;
};

/// `path` is the file, or the folder of a rosbag2. Throws E-ARGUMENT for a compression the container does not have.
std::unique_ptr<BagWriter> make_bag_writer(Container container, const std::string& path,
                                           const BagWriterOptions& options = {});

}  // namespace vispline
