// Seeds for every target, by our own writers: make_seeds <folder> fills <folder>/<target>/.
#include <filesystem>
#include <fstream>

#include "signal_seeds.h"
#include "vispline/io/write_bag.h"

namespace {

using namespace vispline;

std::string message(int index, Wire wire) {
  std::string bytes = wire == Wire::kCdr ? std::string("\0\1\0\0", 4) : std::string(4, '\0');
  store_le(bytes, static_cast<std::uint32_t>(1'600'000'000 + index));
  store_le(bytes, std::uint32_t{5});
  store_le(bytes, std::uint32_t{4});
  bytes += std::string("map", 4);
  bytes.append(37 * 8, static_cast<char>(index));
  return bytes;
}

void bag(Container container, Codec codec, Wire wire, const std::string& path) {
  const auto writer = make_bag_writer(container, path, {.compression = codec, .chunk_bytes = 1000, .force = true});
  for (const char* name : {"/imu", "/pose"}) {
    writer->add_topic({.name = name, .type = "sensor_msgs/Imu", .md5 = {}, .definition = "float64 x", .wire = wire});
  }
  for (int i = 0; i < 9; ++i) writer->write(i % 3 == 0 ? 1 : 0, i * 1'000'000LL, as_bytes(message(i, wire)));
  writer->publish();
}

/// IMU samples on two topics and a trajectory.
void samples(Container container, const std::string& path) {
  ImuSignal imu;
  Signal<Pose> poses;
  for (int i = 0; i < 12; ++i) {
    const Time time = time_from_ns(1'600'000'000'000'000'001 + 5'000'000LL * i);
    imu.push_back(time, {Vector3d(0.1, 0.2, 0.03 * i), Vector3d(0.5, 0.01 * i, 9.7)});
    poses.push_back(time, {Matrix3d::Identity(), Vector3d(0.1 * i, 0.0, 1.0)});
  }
  SignalBagWriter writer(container, path, {.chunk_bytes = 1500, .force = true});
  writer.write_imu("/imu", imu.time, imu.value);
  writer.write_imu("/accel", imu.time, imu.value);
  writer.write_poses("/pose", poses);
  writer.publish();
}

void put(const std::string& path, const std::string& bytes) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string root = std::string(argv[1]) + "/";
  for (const Codec codec : {Codec::kNone, Codec::kBz2, Codec::kLz4}) {
    bag(Container::kRosbag, codec, Wire::kRos1, root + "rosbag/" + std::string(name_of(codec)));
  }
  for (const Codec codec : {Codec::kNone, Codec::kLz4, Codec::kZstd}) {
    bag(Container::kMcap, codec, Wire::kCdr, root + "mcap/" + std::string(name_of(codec)));
  }
  samples(Container::kRosbag, root + "samples/rosbag");
  samples(Container::kMcap, root + "samples/mcap");
  bag(Container::kRosbag2, Codec::kNone, Wire::kCdr, root + "rosbag2");
  std::filesystem::create_directories(root + "db3");
  std::filesystem::rename(root + "rosbag2/rosbag2_0.db3", root + "db3/seed");
  std::filesystem::create_directories(root + "metadata");
  std::filesystem::rename(root + "rosbag2/metadata.yaml", root + "metadata/seed");
  std::filesystem::remove(root + "rosbag2");
  put(root + "message/ros1", std::string(1, '\0') + message(1, Wire::kRos1));
  put(root + "message/cdr", "\1" + message(1, Wire::kCdr));
  for (const Codec codec : {Codec::kBz2, Codec::kLz4, Codec::kZstd}) {
    const std::string head = {static_cast<char>(static_cast<int>(codec) - 1), 20};
    put(root + "chunk/" + std::string(name_of(codec)), head + encode(codec, message(1, Wire::kRos1)));
  }
  for (const auto& [name, bytes] : vispline::fuzz::signal_seeds()) put(root + name, bytes);
  return 0;
}
