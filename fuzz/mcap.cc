#include "check_bag.h"
#include "vispline/bags/mcap_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  fuzz::index_equals_scan(
      [&](const BagOptions& options) { return open_mcap(Input::from_memory(bytes, "fuzz"), options); });
  return 0;
}
