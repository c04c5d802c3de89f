#include "vispline/io/png.h"

#include <gtest/gtest.h>

#include "vispline/bags/mcap_records.h"
#include "vispline/core/error.h"

namespace vispline {
namespace {

GreyImage generic_image(int width, int height) {
  GreyImage image{width, height};
  std::uint32_t state = 12345;
  for (int i = 0; i < width * height; ++i) {
    state = state * 1664525u + 1013904223u;
    image.grey.push_back(static_cast<std::uint8_t>(state >> 24));
  }
  return image;
}

TEST(Png, ReadsBackWhatWasWritten) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 5), std::pair(640, 480)}) {
    const GreyImage image = generic_image(width, height);
    const std::string bytes = png_bytes(image);
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    EXPECT_EQ(bytes[24], 8);  // bits
    EXPECT_EQ(bytes[25], 0);  // grey
    const GreyImage back = decode_png(bytes, "test.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.grey, image.grey);
  }
}

TEST(Png, BrokenOnesAreErrorsWithTheirName) {
  const std::string bytes = png_bytes(generic_image(40, 30));
  for (const std::string& broken :
       {std::string(), std::string("not an image"), bytes.substr(0, 20), bytes.substr(0, 500)}) {
    try {
      decode_png(broken, "frame.png");
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.diagnostic().code, "E-IMAGE");
      EXPECT_EQ(error.diagnostic().where, "frame.png");
    }
  }
  EXPECT_THROW(png_bytes({}), Error);
  EXPECT_THROW(png_bytes({2, 2, {1, 2, 3}}), Error);
}

/// What a header claims is held against the cap before memory is taken.
TEST(Png, HeaderThatClaimsTooMuch) {
  std::string bytes = png_bytes(generic_image(40, 30));
  bytes.replace(16, 8, std::string("\0\0\x20\x01\0\0\x20\0", 8));  // 8193 x 8192
  const std::uint32_t crc = mcap::crc32_of(as_bytes(bytes).subspan(12, 17));
  for (int i = 0; i < 4; ++i) bytes[static_cast<std::size_t>(29 + i)] = static_cast<char>(crc >> (24 - 8 * i));
  try {
    decode_png(bytes, "frame.png");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostic().code, "E-LIMIT");
    EXPECT_EQ(error.exit_code(), ExitCode::kLimit);
  }
}

}  // namespace
}  // namespace vispline
