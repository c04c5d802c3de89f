#include "vispline/io/png.h"

#include <png.h>

#include <cstdint>
#include <vector>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26;

/// libpng's simplified interface; frees what it holds.
struct PngImage {
  png_image image{};
  PngImage() { image.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw Error(ExitCode::kInput, {.code = "E-IMAGE",
                                 .message = "no PNG image in " + vispline::quoted(name) + ": " + what,
                                 .where = name,
                                 .effect = "image not read",
                                 .next = "give a whole PNG file"});
}

}  // namespace

std::string png_bytes(const GreyImage& image) {
  require(image.width > 0 && image.height > 0 &&
              image.grey.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
          "an image with pixels");
  PngImage png;
  png.image.width = static_cast<png_uint_32>(image.width);
  png.image.height = static_cast<png_uint_32>(image.height);
  png.image.format = PNG_FORMAT_GRAY;
  png.image.flags = PNG_IMAGE_FLAG_FAST;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png.image), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&png.image, bytes.data(), &size, 0, image.grey.data(), 0, nullptr)) {
    throw Error(ExitCode::kOutput, {.code = "E-OUTPUT",
                                    .message = std::string("cannot make a PNG: ") + png.image.message,
                                    .where = "",
                                    .effect = "image not written",
                                    .next = ""});
  }
  bytes.resize(size);
  return bytes;
}

GreyImage decode_png(std::string_view bytes, const std::string& name) {
  PngImage png;
  if (!png_image_begin_read_from_memory(&png.image, bytes.data(), bytes.size())) fail(name, png.image.message);
  if (std::uint64_t{png.image.width} * png.image.height > kMostPixels) {
    throw Error(ExitCode::kLimit,
                {.code = "E-LIMIT",
                 .message = "the image in " + vispline::quoted(name) + " has " + std::to_string(png.image.width) +
                            " x " + std::to_string(png.image.height) + " pixels",
                 .where = name,
                 .effect = "image not read",
                 .next = "at most 2^26 pixels are read"});
  }
  png.image.format = PNG_FORMAT_GRAY;
  GreyImage image{static_cast<int>(png.image.width), static_cast<int>(png.image.height)};
  image.grey.resize(PNG_IMAGE_SIZE(png.image));
  if (!png_image_finish_read(&png.image, nullptr, image.grey.data(), 0, nullptr)) fail(name, png.image.message);
  return image;
}

}  // namespace vispline
