/// One small recording of each container, cut at every byte: no crash, and what is read never shrinks with the length.
#include <filesystem>

#include "vispline/io/bag_testing.h"

namespace vispline {
namespace {

struct Sweep {
  std::string path;
  std::int64_t whole = 0;
  std::int64_t read_at_all = 0;  ///< lengths at which something was read
};

/// From the whole file down to nothing, `step` bytes at a time.
Sweep sweep(const std::string& path, std::uint64_t step) {
  Sweep result{.path = path};
  std::int64_t before = INT64_MAX;
  for (std::uint64_t size = std::filesystem::file_size(path);; size -= std::min(step, size)) {
    std::filesystem::resize_file(path, size);
    std::int64_t kept = 0;
    try {
      const auto imu = read_imu(path, {.repair = true});
      EXPECT_EQ(imu.counts.read, imu.counts.kept + imu.counts.dropped_total());
      kept = imu.counts.kept;
    } catch (const Error& error) {
      EXPECT_NE(error.exit_code(), ExitCode::kDone);
      EXPECT_TRUE(error.diagnostic().code.starts_with("E-"));
    }
    EXPECT_LE(kept, before) << size;
    if (before == INT64_MAX) result.whole = kept;
    before = kept;
    result.read_at_all += kept > 0;
    if (size == 0) return result;
  }
}

TEST(BagTruncation, AtEveryByte) {
  const ScratchFolder folder;
  const ImuSignal imu = random_imu(12, 4);
  for (const Codec codec : {Codec::kNone, Codec::kLz4}) {
    for (const Container container : {Container::kRosbag, Container::kMcap}) {
      const std::string path = write_bag(folder.path("f"), imu_messages(imu, wire_of(container)), container,
                                         {.compression = codec, .chunk_bytes = 1500});
      const Sweep swept = sweep(path, 1);
      EXPECT_EQ(swept.whole, 12);
      EXPECT_GT(swept.read_at_all, 1000);
    }
  }
}

TEST(BagTruncation, OfADatabase) {
  const ScratchFolder folder;
  const std::string bag = write_bag(folder.path("f"), imu_messages(random_imu(12, 4), Wire::kCdr), Container::kRosbag2);
  for (const auto& entry : std::filesystem::directory_iterator(bag)) {
    if (entry.path().extension() == ".db3") {
      EXPECT_EQ(sweep(entry.path().string(), 61).whole, 12);
    }
  }
}

TEST(BagTruncation, OfATable) {
  const ScratchFolder folder;
  std::string text = "t,gx,gy,gz,ax,ay,az\n";
  for (int i = 0; i < 12; ++i) text += std::to_string(100.0 + 0.005 * i) + ",0.1,0.2,0.3,0.4,0.5,9.8\n";
  EXPECT_EQ(sweep(folder.write("f.csv", text), 1).whole, 12);
}

}  // namespace
}  // namespace vispline
