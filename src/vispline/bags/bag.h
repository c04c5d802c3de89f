/// Recorded messages as bytes: what every container of recordings (rosbag v1, MCAP, rosbag2) has in common. Knows no
/// sensor; ros_messages.h decodes. docs/bags.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vispline/bags/bytes.h"
#include "vispline/core/error.h"

namespace vispline {

/// How the fields of a message are laid out in its bytes.
enum class Wire { kRos1, kCdr, kOther };

/// One connection of a rosbag, one channel of an MCAP file, one row of a rosbag2 table of topics: a recording may hold
/// several with one name.
struct Topic {
  std::string name;
  std::string type;        ///< "sensor_msgs/Imu", or "sensor_msgs/msg/Imu" of ROS 2
  std::string md5;         ///< of the definition, 32 digits (ROS 1); may be empty
  std::string definition;  ///< text of the message definition; may be empty
  Wire wire = Wire::kRos1;
  std::string encoding = {};               ///< as the file names it: "ros1", "cdr", "protobuf"
  std::optional<std::int64_t> count = {};  ///< messages, as the index or a scan says; absent if nothing says so
};

struct Message {
  std::size_t topic = 0;        ///< index into topics()
  std::int64_t receive_ns = 0;  ///< when the recorder got it, ns since 1970; not the stamp of its header
  Bytes data;                   ///< good until the sink returns
  std::uint64_t offset =
      0;  ///< byte in the file of its record, or of the compressed chunk that holds it; rowid in a database
};

/// A part of the file that gave no messages.
struct LostSpan {
  std::uint64_t offset = 0, bytes = 0;
  std::optional<std::int64_t> begin_ns = {}, end_ns = {};  ///< receive times, as far as anything tells them
};

struct BagOptions {
  bool use_index = true;  ///< false: believe the data only, which reads all of it once more
  bool repair = false;    ///< take what is there instead of failing when more than 1 % of the time is lost
  /// Called about once a MiB with bytes read and in all; false stops the run with what was read so far.
  std::function<bool(std::uint64_t done, std::uint64_t total)> progress = {};
};

using TopicFilter = std::function<bool(const Topic&)>;
/// False stops the run.
using MessageSink = std::function<bool(const Message&)>;

/// An open recording. Not thread-safe; the file is never changed. Peak memory: one decompressed chunk (at most 256 MiB)
/// and buffers of a few MiB.
class BagReader {
 public:
  explicit BagReader(BagOptions options) : options_(std::move(options)) {}
  virtual ~BagReader() = default;
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  /// In the order of the file. Never empty entries; their number and order stay the same for the life of the reader.
  const std::vector<Topic>& topics() const { return topics_; }

  /// Every message of the topics that pass, **in the order of the file**: that in which they were recorded, so
  /// nearly by receive time, which nothing guarantees. May be called again. Throws E-CHUNK (exit 3) at the end if
  /// more than 1 % of the time between the first and the last message was lost to damage, unless repair is set.
  void read(const TopicFilter& wanted, const MessageSink& sink);

  /// Warnings of opening and of the last read().
  const Diagnostics& diagnostics() const { return diagnostics_; }
  /// Of the last read(), wanted topics only: read = kept (given to the sink) + dropped.
  const ReadCounts& counts() const { return counts_; }
  /// What opening and the last read() could not read.
  const std::vector<LostSpan>& lost() const { return lost_; }
  /// Whether the index was found and agrees with the file.
  bool indexed() const { return indexed_; }

 protected:
  /// `wanted[i]` for topics()[i]; calls deliver(), drop() and lose().
  virtual void read_all(const std::vector<bool>& wanted) = 0;

  /// False: stop.
  bool deliver(const Message& message);
  void drop(const std::string& code, const std::string& message, const std::string& where);
  void lose(LostSpan span, const std::string& code, const std::string& message, const std::string& where,
            const std::string& effect);
  void warn(const std::string& code, const std::string& message, const std::string& where, const std::string& effect);
  /// False: stop.
  bool report_progress(std::uint64_t done, std::uint64_t total);
  /// Takes warnings, drops and losses of one file of many over, after its read() or, if `opening`, after it was opened.
  void absorb(const BagReader& part, bool opening);
  /// What was warned of until now belongs to the file, not to one run of read().
  void keep_warnings_of_opening();

  BagOptions options_;
  std::vector<Topic> topics_;
  bool indexed_ = false;

 private:
  void refuse_if_much_is_lost() const;

  const MessageSink* sink_ = nullptr;
  Diagnostics diagnostics_, opening_;
  ReadCounts counts_;
  std::vector<LostSpan> lost_, lost_at_opening_;
  std::optional<std::int64_t> first_ns_, last_ns_;
  std::optional<std::size_t> open_loss_;  ///< it ends at the next message
  std::uint64_t next_report_ = 0;
};

/// "file.bag, byte 1234".
std::string place(const std::string& name, std::uint64_t offset);
/// E-CORRUPT, exit 3.
[[noreturn]] void fail_corrupt(const std::string& where, const std::string& message);
/// E-UNSUPPORTED, exit 3.
[[noreturn]] void fail_unsupported(const std::string& where, const std::string& message, const std::string& next);
/// E-LIMIT, exit 7.
[[noreturn]] void fail_limit(const std::string& where, const std::string& message);

}  // namespace vispline
