#include "vispline/files/content_type.h"

#include <algorithm>
#include <array>

namespace vispline {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  std::string_view name;
};

constexpr std::array kMagics = {
    Magic{"#ROSBAG V"sv, "a rosbag"},
    Magic{"\x89MCAP"sv, "an MCAP file"},
    Magic{"SQLite format 3"sv, "an SQLite database (rosbag2?)"},
    Magic{"PK\x03\x04"sv, "a zip archive"},
    Magic{"PK\x05\x06"sv, "an empty zip archive"},
    Magic{"BZh"sv, "a bzip2 stream"},
    Magic{"\x28\xb5\x2f\xfd"sv, "a zstd stream"},
    Magic{"\x04\x22\x4d\x18"sv, "an lz4 stream"},
    Magic{"7z\xbc\xaf\x27\x1c"sv, "a 7z archive"},
    Magic{"\x1f\x8b"sv, "a gzip stream inside a compressed file"},
    Magic{"\xfd"
          "7zXZ\0"sv,
          "an xz stream inside a compressed file"},
    Magic{"\x7f"
          "ELF"sv,
          "a program"},
    Magic{"%PDF-"sv, "a PDF document"},
    Magic{"\x89PNG"sv, "a PNG image"},
    Magic{"\xff\xd8\xff"sv, "a JPEG image"},
    Magic{"\x89HDF"sv, "an HDF5 file"},
    Magic{"MATLAB 5.0 MAT-file"sv, "a binary MATLAB file"},
    Magic{"\x93NUMPY"sv, "a NumPy array"},
    Magic{"\xff\xfe"sv, "UTF-16 text"},
    Magic{"\xfe\xff"sv, "UTF-16 text"},
    Magic{"<!DOCTYPE"sv, "an HTML page"},
    Magic{"<html"sv, "an HTML page"},
    Magic{"<?xml"sv, "an XML document"},
    Magic{"{\""sv, "JSON"},
    Magic{"%YAML"sv, "YAML"},
    Magic{"version https://git-lfs"sv, "a Git LFS pointer, not the file itself"},
};

bool is_control(unsigned char c) { return (c < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f') || c == 0x7f; }

/// Every second byte of ASCII text in UTF-16 is NUL.
bool looks_utf16(std::string_view head) {
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < head.size(); ++i) zeros[i % 2] += head[i] == '\0';
  const std::size_t half = head.size() / 2;
  return half >= 8 && std::max(zeros[0], zeros[1]) * 10 > half * 9 && std::min(zeros[0], zeros[1]) * 10 < half;
}

}  // namespace

std::optional<std::string_view> not_text(std::string_view bytes) {
  for (const Magic& magic : kMagics) {
    if (bytes.starts_with(magic.bytes)) return magic.name;
  }
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  const std::string_view head = bytes.substr(0, 4096);
  if (looks_utf16(head)) return "UTF-16 text";
  const auto controls =
      std::count_if(head.begin(), head.end(), [](char c) { return is_control(static_cast<unsigned char>(c)); });
  const auto high =
      std::count_if(head.begin(), head.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  const auto size = static_cast<std::ptrdiff_t>(head.size());
  if (controls * 10 > size || high * 4 > size) return "binary data";
  return std::nullopt;
}

}  // namespace vispline
