// Any bytes as KITTI poses: what is read must survive writing and reading.
#include "vispline/io/kitti.h"
#include "read_result_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline;
  using namespace vispline::fuzz;
  static MemoryFile input, output;
  const std::string path = input.put(data, size);
  const ReadOptions options{.format = "kitti", .rate_hz = 10.0};
  ReadResult<Signal<Pose>> poses, again;
  if (!read_with<Pose>([&] { return read_trajectory(path, options); }, poses)) return 0;
  const std::string text = kitti::text(poses.value);
  const std::string written = output.put(text.data(), text.size());
  must(read_with<Pose>([&] { return read_trajectory(written, options); }, again));
  must_be_same(again.value, poses.value);
  return 0;
}
