// Any bytes as a TUM trajectory: what is read must survive writing and reading.
#include "vispline/io/tum.h"
#include "read_result_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline;
  using namespace vispline::fuzz;
  static MemoryFile input, output;
  const std::string path = input.put(data, size);
  ReadResult<Signal<Pose>> poses, again;
  if (!read_with<Pose>([&] { return read_trajectory(path, {.format = "tum"}); }, poses)) return 0;
  const std::string text = tum::text(poses.value);
  const std::string written = output.put(text.data(), text.size());
  if (!read_with<Pose>([&] { return read_trajectory(written, {.format = "tum", .repair = true}); }, again)) return 0;
  if (again.counts.kept != again.counts.read) return 0;
  must(again.value.time == poses.value.time);
  must_be_same(again.value, poses.value);
  return 0;
}
