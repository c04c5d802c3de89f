// One recording in every container and compression, for readers of others: write_recordings <folder>.
#include <zlib.h>

#include <bit>
#include <fstream>

#include "vispline/bags/bag_writer.h"

namespace {

using namespace vispline;

const char* const kDefinition =
    "std_msgs/Header header\ngeometry_msgs/Point point\n"
    "================================================================================\nMSG: std_msgs/Header\n"
    "uint32 seq\ntime stamp\nstring frame_id\n"
    "================================================================================\nMSG: geometry_msgs/Point\n"
    "float64 x\nfloat64 y\nfloat64 z\n";

/// A PointStamped.
std::string message(int index, Wire wire) {
  std::string bytes = wire == Wire::kCdr ? std::string("\0\1\0\0", 4) : std::string(4, '\0');
  store_le(bytes, static_cast<std::uint32_t>(1'600'000'000 + index));
  store_le(bytes, std::uint32_t{5});
  store_le(bytes, std::uint32_t{wire == Wire::kCdr ? 4u : 3u});
  bytes += "map";
  if (wire == Wire::kCdr) bytes.append(1, '\0');
  for (int i = 0; i < 3; ++i) store_le(bytes, std::bit_cast<std::uint64_t>(0.1 * index + i));
  return bytes;
}

struct Row {
  std::string topic;
  std::int64_t time_ns;
  unsigned long crc;
};

void write(Container container, Codec codec, const std::string& path, Wire wire) {
  const auto writer = make_bag_writer(container, path, {.compression = codec, .chunk_bytes = 5000, .force = true});
  const bool cdr = wire == Wire::kCdr;
  for (const char* name : {"/a", "/b"}) {
    writer->add_topic({.name = name,
                       .type = cdr ? "geometry_msgs/msg/PointStamped" : "geometry_msgs/PointStamped",
                       .md5 = cdr ? "" : "c63aecb41bfdfd6b7e1fac37c7cbe7bf",
                       .definition = kDefinition,
                       .wire = wire});
  }
  for (int i = 0; i < 500; ++i)
    writer->write(i % 3 == 0 ? 1 : 0, 1'600'000'000'000'000'000 + i * 7'000'001LL, as_bytes(message(i, wire)));
  writer->publish();
}

void write_expected(const std::string& path, Wire wire) {
  std::ofstream out(path);
  for (int i = 0; i < 500; ++i) {
    const std::string bytes = message(i, wire);
    const auto crc = ::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    out << (i % 3 == 0 ? "/b" : "/a") << '\t' << 1'600'000'000'000'000'000 + i * 7'000'001LL << '\t' << crc << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto path = [&](const char* wire, const std::string& name) {
    return std::string(argv[1]) + "/" + wire + "/" + name;
  };
  for (const Codec codec : {Codec::kNone, Codec::kBz2, Codec::kLz4}) {
    write(Container::kRosbag, codec, path("ros1", std::string(name_of(codec)) + ".bag"), Wire::kRos1);
  }
  for (const Codec codec : {Codec::kNone, Codec::kLz4, Codec::kZstd}) {
    write(Container::kMcap, codec, path("ros1", std::string(name_of(codec)) + ".mcap"), Wire::kRos1);
    write(Container::kMcap, codec, path("cdr", std::string(name_of(codec)) + ".mcap"), Wire::kCdr);
  }
  write(Container::kRosbag2, Codec::kNone, path("cdr", "rosbag2"), Wire::kCdr);
  write_expected(path("ros1", "expected.txt"), Wire::kRos1);
  write_expected(path("cdr", "expected.txt"), Wire::kCdr);
  return 0;
}
