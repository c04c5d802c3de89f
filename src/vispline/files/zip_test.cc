#include "vispline/files/zip.h"

#include <gtest/gtest.h>

namespace vispline {
namespace {

std::uint32_t le(const std::string& bytes, std::size_t at, int width) {
  std::uint32_t value = 0;
  for (int i = width - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

// CRC-32 of "123456789" is 0xcbf43926, the check value of the standard.
TEST(Zip, LayoutOfOneStoredEntry) {
  ZipText zip;
  zip.add("nine.txt", "123456789");
  const std::string bytes = zip.finish();
  EXPECT_EQ(le(bytes, 0, 4), 0x04034b50u);
  EXPECT_EQ(le(bytes, 14, 4), 0xcbf43926u);
  EXPECT_EQ(le(bytes, 18, 4), 9u);
  EXPECT_EQ(le(bytes, 22, 4), 9u);
  EXPECT_EQ(bytes.substr(30, 17), "nine.txt123456789");
  const std::size_t directory = 30 + 17;
  EXPECT_EQ(le(bytes, directory, 4), 0x02014b50u);
  EXPECT_EQ(le(bytes, directory + 42, 4), 0u);  // offset of the entry
  const std::size_t end = directory + 46 + 8;
  ASSERT_EQ(bytes.size(), end + 22);
  EXPECT_EQ(le(bytes, end, 4), 0x06054b50u);
  EXPECT_EQ(le(bytes, end + 10, 2), 1u);
  EXPECT_EQ(le(bytes, end + 12, 4), 54u);
  EXPECT_EQ(le(bytes, end + 16, 4), directory);
}

}  // namespace
}  // namespace vispline
