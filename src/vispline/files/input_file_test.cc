#include "vispline/files/input_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include "vispline/files/compressor.h"
#include "vispline/files/decompress.h"
#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

using namespace std::string_literals;

Outcome open_outcome(const std::string& path) {
  try {
    read_text_file(path);
  } catch (const Error& error) {
    Outcome outcome;
    outcome.exit = static_cast<int>(error.exit_code());
    outcome.codes = error.diagnostic().code;
    outcome.message = error.diagnostic().message;
    return outcome;
  }
  return {};
}

std::string packed(const std::string& suffix, const std::string& text) {
  std::string out;
  compressor_for("x" + suffix)->compress(text, true, out);
  return out;
}

TEST(InputFile, OpensRegularFilesOnly) {
  const ScratchFolder folder;
  ::mkfifo(folder.path("fifo").c_str(), 0600);
  ASSERT_EQ(::symlink("nowhere", folder.path("dangling").c_str()), 0);
  ASSERT_EQ(::symlink("loop", folder.path("loop").c_str()), 0);
  for (const auto& [path, reason] :
       std::vector<std::pair<std::string, std::string>>{{folder.path("absent"), "No such file"},
                                                        {folder.path("fifo"), "FIFO"},
                                                        {folder.path(""), "folder"},
                                                        {folder.path("dangling"), "points nowhere"},
                                                        {folder.path("loop"), "symbolic links"},
                                                        {"/dev/zero", "device"},
                                                        {"", "No such file"},
                                                        {"a\0b"s, "NUL"}}) {
    const Outcome outcome = open_outcome(path);
    EXPECT_EQ(outcome.exit, 3) << path;
    EXPECT_EQ(outcome.codes, "E-OPEN") << path;
    EXPECT_NE(outcome.message.find(reason), std::string::npos) << outcome.message;
  }
}

TEST(InputFile, FollowsALinkToARegularFile) {
  const ScratchFolder folder;
  folder.write("file", "1,2\n");
  ASSERT_EQ(::symlink("file", folder.path("link").c_str()), 0);
  EXPECT_EQ(read_text_file(folder.path("link")), "1,2\n");
}

TEST(InputFile, ContentDecidesNotTheName) {
  const ScratchFolder folder;
  const std::string text = "t,gx\n0.1,2\n";
  EXPECT_EQ(read_text_file(folder.write("a.csv.xz", text)), text);
  EXPECT_EQ(read_text_file(folder.write("a.csv", packed(".xz", text))), text);
  EXPECT_EQ(read_text_file(folder.write("b.csv", packed(".gz", text))), text);
  EXPECT_EQ(read_text_file(folder.write("c.csv", packed(".gz", text) + packed(".gz", text))), text + text);
  EXPECT_EQ(read_text_file(folder.write("d.csv", packed(".xz", text) + packed(".xz", text))), text + text);
}

TEST(InputFile, NamesWhatItFound) {
  const ScratchFolder folder;
  std::string noise;
  const RandomStream random(4, "bytes");
  for (std::uint64_t i = 0; i < 4096; ++i)
    noise += static_cast<char>(static_cast<int>(random.uniform_pair(i)[0] * 256.0));
  for (const auto& [bytes, name] :
       std::vector<std::pair<std::string, std::string>>{{"#ROSBAG V2.0\n", "rosbag"},
                                                        {"\x89MCAP0\r\n", "MCAP"},
                                                        {"SQLite format 3\0"s, "SQLite"},
                                                        {"PK\x03\x04xx", "zip"},
                                                        {"\xff\xfe"
                                                         "1\0,\0"s,
                                                         "UTF-16"},
                                                        {"1\0,\0002\0,\0003\0\n\0004\0,\0005\0,\0006\0\n\0"s, "UTF-16"},
                                                        {packed(".gz", packed(".gz", "1,2\n")), "gzip stream inside"},
                                                        {"\x7f"
                                                         "ELF\2\1\1",
                                                         "program"},
                                                        {"x" + noise, "binary"}}) {
    const Outcome outcome = open_outcome(folder.write("f", bytes));
    EXPECT_EQ(outcome.exit, 3);
    EXPECT_EQ(outcome.codes, "E-FORMAT");
    EXPECT_NE(outcome.message.find(name), std::string::npos) << outcome.message << " wanted " << name;
  }
}

TEST(InputFile, DamagedAndCutStreamsSayWhere) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 60; ++i) text += std::to_string(i * 7919) + ",1.5\n";
  for (const std::string& suffix : {std::string(".gz"), std::string(".xz")}) {
    const std::string good = packed(suffix, text);
    for (std::size_t length = 6; length < good.size(); ++length) {
      const Outcome outcome = open_outcome(folder.write("f", good.substr(0, length)));
      ASSERT_EQ(outcome.codes, "E-CORRUPT") << suffix << " cut at " << length;
      ASSERT_EQ(outcome.exit, 3);
      ASSERT_NE(outcome.message.find("at byte"), std::string::npos);
    }
    std::string bad = good;
    bad[good.size() / 2] = static_cast<char>(bad[good.size() / 2] ^ 0x55);
    EXPECT_EQ(open_outcome(folder.write("f", bad)).codes, "E-CORRUPT") << suffix;
  }
}

TEST(InputFile, BlocksOfAnySizeGiveTheSameBytes) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 3000; ++i) text += std::to_string(i * 7919) + ",1.5\n";
  const std::string two_members = packed(".gz", text.substr(0, 5000)) + packed(".gz", text.substr(5000));
  const std::string padded_xz = packed(".xz", text) + std::string(8, '\0');
  for (const std::string& bytes : {text, two_members, two_members + std::string(512, '\0'), padded_xz}) {
    const std::string path = folder.write("f", bytes);
    for (const std::size_t block : {std::size_t{1}, std::size_t{7}, std::size_t{64}, std::size_t{1} << 20}) {
      InputFile file(path, block);
      std::string got, piece(block, '\0');
      while (const std::size_t size = file.read(piece.data(), piece.size())) got.append(piece, 0, size);
      ASSERT_EQ(got, text) << block;
      EXPECT_EQ(file.bytes_done(), bytes.size());
      EXPECT_EQ(file.bytes_total(), bytes.size());
    }
  }
}

TEST(InputFile, WhatIsAppendedWhileReadingIsNotRead) {
  const ScratchFolder folder;
  const std::string path = folder.write("f", "1,2\n");
  InputFile file(path);
  std::ofstream(path, std::ios::app) << "3,4\n";
  std::string piece(100, '\0');
  EXPECT_EQ(file.read(piece.data(), piece.size()), 4u);
  EXPECT_EQ(file.read(piece.data(), piece.size()), 0u);
}

TEST(InputFile, BombsStopAtTheCap) {
  const std::string bomb = packed(".xz", std::string(std::size_t{8} << 20, '0'));
  try {
    decompress("bomb", bomb, Compression::kXz, std::uint64_t{4} << 20);
    FAIL() << "no cap";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostic().code, "E-LIMIT");
    EXPECT_EQ(error.exit_code(), ExitCode::kLimit);
  }
  EXPECT_EQ(decompress("bomb", bomb, Compression::kXz, UINT64_MAX).size(), std::size_t{8} << 20);
  EXPECT_LE(decompress("bomb", bomb, Compression::kXz, UINT64_MAX, 1000).size(), std::size_t{2} << 20);
  EXPECT_EQ(expansion_cap(10), 10000 + (std::uint64_t{1} << 30));
  EXPECT_EQ(expansion_cap(UINT64_MAX / 2), UINT64_MAX);
}

}  // namespace
}  // namespace vispline
