#include "vispline/files/small_file.h"

#include <sys/stat.h>

#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

std::string code_of(const std::string& path, std::size_t cap) {
  try {
    read_small_text_file(path, cap);
  } catch (const Error& error) {
    return error.diagnostic().code + " " + std::to_string(static_cast<int>(error.exit_code()));
  }
  return "";
}

TEST(SmallFile, WholeTextUpToTheCap) {
  const ScratchFolder folder;
  const std::string path = folder.write("imu.yaml", "%YAML:1.0\na: 1\n");
  EXPECT_EQ(read_small_text_file(path, 15), "%YAML:1.0\na: 1\n");
  EXPECT_EQ(code_of(path, 14), "E-LIMIT 7");
  EXPECT_EQ(read_small_text_file(folder.write("a.json", "{\"a\": 1}"), 100), "{\"a\": 1}");
  EXPECT_EQ(read_small_text_file(folder.write("empty", ""), 100), "");
}

TEST(SmallFile, OnlyTextInRegularFiles) {
  const ScratchFolder folder;
  EXPECT_EQ(code_of(folder.path("absent"), 100), "E-OPEN 3");
  EXPECT_EQ(code_of(folder.path(""), 100), "E-OPEN 3");
  EXPECT_EQ(code_of(std::string("a\0b", 3), 100), "E-OPEN 3");
  ASSERT_EQ(::mkfifo(folder.path("fifo").c_str(), 0600), 0);
  EXPECT_EQ(code_of(folder.path("fifo"), 100), "E-OPEN 3");
  EXPECT_EQ(code_of(folder.write("x.bag", "#ROSBAG V2.0\n"), 100), "E-FORMAT 3");
}

}  // namespace
}  // namespace vispline
