#include <cstddef>
#include <cstdint>

#include "vispline/bags/rosbag2_metadata.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vispline::parse_metadata(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
