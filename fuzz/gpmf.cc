// Any bytes as a recording of a device.
#include "read_result_checks.h"
#include "vispline/io/gopro.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline;
  const Input input = Input::from_memory(std::string(reinterpret_cast<const char*>(data), size), "fuzz");
  std::int64_t handed = 0;
  Time last = time_from_ns(INT64_MIN);
  const auto sink = [&](std::span<const Time> time, std::span<const ImuSample>) {
    for (const Time t : time) {
      fuzz::must(last < t);
      last = t;
    }
    handed += static_cast<std::int64_t>(time.size());
  };
  try {
    const ImuStreamResult result = gopro::stream(input, {.repair = true}, sink, {});
    fuzz::must(result.counts.read == result.counts.kept + result.counts.dropped_total());
    fuzz::must(result.counts.kept == handed);
  } catch (const Error& error) {
    fuzz::must(error.diagnostic().code.starts_with("E-"));
  }
  try {
    gopro::readout(input);
  } catch (const Error&) {
  }
  return 0;
}
