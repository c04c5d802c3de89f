// Any bytes as a PNG: what is decoded has its pixels and survives writing and reading.
#include "vispline/io/png.h"

#include <cstdint>

#include "must.h"
#include "vispline/core/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline;
  GreyImage image;
  try {
    image = decode_png({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const Error&) {
    return 0;
  }
  fuzz::must(image.width > 0 && image.height > 0);
  fuzz::must(image.grey.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const GreyImage again = decode_png(png_bytes(image), "again");
  fuzz::must(again.width == image.width && again.height == image.height && again.grey == image.grey);
  return 0;
}
