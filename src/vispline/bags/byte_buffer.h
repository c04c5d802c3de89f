/// A growing byte array that does not clear what it hands out: megabytes are written once, by a decoder.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>

#include "vispline/bags/bytes.h"

namespace vispline {

class ByteBuffer {
 public:
  std::size_t size() const { return size_; }
  std::size_t room() const { return capacity_ - size_; }
  /// Where the next room() bytes go; commit() what was written there.
  std::byte* end() { return bytes_.get() + size_; }
  void commit(std::size_t count) { size_ += count; }
  void clear() { size_ = 0; }
  Bytes view() const { return {bytes_.get(), size_}; }

  /// At least `count` bytes in all; contents are kept.
  void reserve(std::size_t count) {
    if (count <= capacity_) return;
    auto larger = std::make_unique_for_overwrite<std::byte[]>(count);
    if (size_ > 0) std::memcpy(larger.get(), bytes_.get(), size_);
    bytes_ = std::move(larger);
    capacity_ = count;
  }

 private:
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace vispline
