#include "check_bag.h"
#include "vispline/bags/db3_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::read_with([&] { return open_db3_bytes(bytes, "fuzz", {}); });
  return 0;
}
