#include "vispline/files/zip.h"

#include <zlib.h>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr std::uint64_t kMostBytes = UINT32_MAX;
constexpr std::uint32_t kNewYear1980 = (1U << 21) | (1U << 16);  // the earliest date there is: results hold no time

void put(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
}

/// What the head of an entry and its line in the directory share: from the version needed to the extra field.
void put_entry(std::string& out, std::string_view name, std::string_view bytes) {
  put(out, 20, 2);  // version 2.0
  put(out, 0, 2);
  put(out, 0, 2);  // stored
  put(out, kNewYear1980, 4);
  put(out, static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())),
      4);
  put(out, static_cast<std::uint32_t>(bytes.size()), 4);
  put(out, static_cast<std::uint32_t>(bytes.size()), 4);
  put(out, static_cast<std::uint32_t>(name.size()), 2);
  put(out, 0, 2);
}

}  // namespace

void ZipText::add(std::string_view name, std::string_view bytes) {
  const std::uint64_t total = entries_.size() + directory_.size() + bytes.size() + 2 * name.size() + 100;
  if (total > kMostBytes || count_ == UINT16_MAX || name.size() > UINT16_MAX) {
    throw Error(ExitCode::kLimit, {.code = "E-LIMIT",
                                   .message = "a zip archive of more than 4 GiB or 65535 entries",
                                   .where = std::string(name),
                                   .effect = "nothing written",
                                   .next = ""});
  }
  const auto offset = static_cast<std::uint32_t>(entries_.size());
  put(entries_, 0x04034b50, 4);
  put_entry(entries_, name, bytes);
  entries_ += name;
  entries_ += bytes;
  put(directory_, 0x02014b50, 4);
  put(directory_, 20, 2);
  put_entry(directory_, name, bytes);
  put(directory_, 0, 2);  // comment
  put(directory_, 0, 2);  // disk
  put(directory_, 0, 2);
  put(directory_, 0, 4);  // attributes
  put(directory_, offset, 4);
  directory_ += name;
  ++count_;
}

std::string ZipText::finish() {
  const auto begin = static_cast<std::uint32_t>(entries_.size()), size = static_cast<std::uint32_t>(directory_.size());
  std::string out = std::move(entries_) + directory_;
  put(out, 0x06054b50, 4);
  put(out, 0, 4);  // disks
  put(out, count_, 2);
  put(out, count_, 2);
  put(out, size, 4);
  put(out, begin, 4);
  put(out, 0, 2);
  return out;
}

}  // namespace vispline
