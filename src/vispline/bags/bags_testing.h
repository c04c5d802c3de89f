/// Shared by the tests of this folder: scratch folders, made-up recordings, readers and their outcome as plain values.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "vispline/bags/bag_writer.h"
#include "vispline/bags/open_bag.h"
#include "vispline/core/random.h"

namespace vispline {

class BagFolder {
 public:
  BagFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "vispline_bags_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~BagFolder() { std::filesystem::remove_all(path_); }
  BagFolder(const BagFolder&) = delete;
  BagFolder& operator=(const BagFolder&) = delete;
  std::string path(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::string path_;
};

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Recorded {
  std::string topic;
  std::int64_t receive_ns = 0;
  std::string data;
  bool operator==(const Recorded&) const = default;
};

struct Recording {
  std::vector<Topic> topics;
  std::vector<Recorded> messages;
};

/// `count` messages of three topics, of 0 to `largest` bytes, 1 ms apart.
inline Recording made_up(std::size_t count, std::size_t largest, Wire wire, std::uint64_t seed = 1) {
  Recording made;
  const bool cdr = wire == Wire::kCdr;
  for (const char* name : {"/imu", "/never", "/pose", "imu without slash"}) {
    made.topics.push_back({.name = name,
                           .type = cdr ? "sensor_msgs/msg/Imu" : "sensor_msgs/Imu",
                           .md5 = cdr ? "" : "6a62c6daae103f4ff57a132d6f95cec2",
                           .definition = "Header header\nfloat64 x=" + std::string(name),
                           .wire = wire,
                           .encoding = cdr ? "cdr" : "ros1"});
  }
  const RandomStream random(seed, "recording");
  for (std::size_t i = 0; i < count; ++i) {
    const auto draw = random.uniform_pair(i);
    const std::size_t topic = i % 5 == 4 ? 3 : (i % 3 == 0 ? 2 : 0);
    std::string data(static_cast<std::size_t>(draw[0] * static_cast<double>(largest)), '\0');
    for (std::size_t k = 0; k < data.size(); ++k)
      data[k] = static_cast<char>(draw[1] * 1e6 + static_cast<double>(k % 50));
    if (cdr && data.size() >= 4) data.replace(0, 4, std::string("\0\1\0\0", 4));
    made.messages.push_back(
        {made.topics[topic].name, 1'600'000'000'000'000'000 + static_cast<std::int64_t>(i) * 1'000'000, data});
  }
  return made;
}

inline void write_recording(const Recording& recording, BagWriter& writer) {
  std::map<std::string, std::size_t> numbers;
  for (const Topic& topic : recording.topics) numbers[topic.name] = writer.add_topic(topic);
  for (const Recorded& message : recording.messages) {
    writer.write(numbers.at(message.topic), message.receive_ns, as_bytes(message.data));
  }
  writer.publish();
}

inline std::string written(const BagFolder& folder, const std::string& name, const Recording& recording,
                           Container container, BagWriterOptions options = {}) {
  options.force = true;
  write_recording(recording, *make_bag_writer(container, folder.path(name), options));
  return folder.path(name);
}

/// What a reader did.
struct BagOutcome {
  int exit = 0;
  std::string codes = {};  ///< of the warnings, in alphabetical order, or of the one error
  std::string text = {};   ///< of the first warning or of the error
  bool indexed = false;
  std::vector<Topic> topics = {};
  std::vector<Recorded> messages = {};
  std::vector<LostSpan> lost = {};
};

inline BagOutcome outcome_of(
    BagReader& reader, const TopicFilter& wanted = [](const Topic&) { return true; }) {
  BagOutcome outcome{.indexed = reader.indexed(), .topics = reader.topics()};
  try {
    reader.read(wanted, [&](const Message& message) {
      outcome.messages.push_back(
          {reader.topics()[message.topic].name, message.receive_ns, std::string(as_text(message.data))});
      return true;
    });
    EXPECT_EQ(reader.counts().read, reader.counts().kept + reader.counts().dropped_total());
    EXPECT_EQ(reader.counts().kept, static_cast<std::int64_t>(outcome.messages.size()));
  } catch (const Error& error) {
    outcome.exit = static_cast<int>(error.exit_code());
    outcome.codes = error.diagnostic().code;
    outcome.text = error.what();
  }
  outcome.lost = reader.lost();
  if (outcome.exit != 0) return outcome;
  for (const auto& [code, count] : reader.diagnostics().counts()) {
    outcome.codes += (outcome.codes.empty() ? "" : " ") + code;
  }
  if (!reader.diagnostics().empty()) outcome.text = to_text(reader.diagnostics().examples().front());
  return outcome;
}

template <class Open>
BagOutcome outcome_of_opening(const Open& open) {
  try {
    return outcome_of(*open());
  } catch (const Error& error) {
    return {.exit = static_cast<int>(error.exit_code()), .codes = error.diagnostic().code, .text = error.what()};
  }
}

inline BagOutcome outcome_of_file(const std::string& path, const BagOptions& options = {}) {
  return outcome_of_opening([&] { return open_bag(path, options); });
}

inline BagOutcome outcome_of_bytes(const std::string& bytes, const BagOptions& options = {}) {
  return outcome_of_opening([&] { return open_bag(Input::from_memory(bytes, "memory"), options); });
}

/// Whether `part` is `whole` with some messages left out.
inline bool is_part_of(const std::vector<Recorded>& part, const std::vector<Recorded>& whole) {
  std::size_t next = 0;
  for (const Recorded& message : whole) next += next < part.size() && part[next] == message;
  return next == part.size();
}

}  // namespace vispline
