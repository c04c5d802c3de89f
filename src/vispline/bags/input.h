/// Bytes of a recording by offset: a regular file opened read-only, or memory. Files of any size are read piece by
/// piece.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "vispline/bags/bytes.h"

namespace vispline {

/// Where the bytes come from. Files are never mapped, so one that shrinks meanwhile only reads short.
class Input {
 public:
  /// Throws E-OPEN with the reason (exit 3) unless `path` is a regular file that can be read.
  static Input open(const std::string& path);
  /// Takes an open descriptor over; `name` is for messages.
  static Input from_descriptor(int fd, std::string name);
  static Input from_memory(std::string bytes, std::string name);
  ~Input();
  Input(Input&& other) noexcept;
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  Input& operator=(Input&&) = delete;

  const std::string& name() const { return name_; }
  /// As it was when opened.
  std::uint64_t size() const { return size_; }
  /// Copies up to `size` bytes; fewer only where the input ends. Throws E-OPEN if the device fails.
  std::size_t read_at(std::uint64_t offset, std::byte* to, std::size_t size) const;
  /// The first bytes, at most `size`.
  std::string head(std::size_t size) const;

 private:
  Input(int fd, std::uint64_t size, std::string memory, std::string name);

  int fd_ = -1;
  std::uint64_t size_ = 0;
  std::string memory_;
  std::string name_;
};

/// Views into an input through one buffer. Memory: the buffer grows to the largest view that was asked for.
class Window {
 public:
  /// `input` must outlive the window. Each refill takes at least `read_ahead` bytes.
  explicit Window(const Input& input, std::size_t read_ahead = std::size_t{1} << 20)
      : input_(&input), read_ahead_(read_ahead), size_(input.size()) {}
  /// All of it is at hand.
  explicit Window(Bytes memory) : data_(memory.data()), length_(memory.size()), size_(memory.size()) {}

  std::uint64_t size() const { return size_; }
  /// Bytes [offset, offset + size), shorter only where the input ends; good until the next call. `size` is trusted:
  /// check what a file claims against a cap first.
  Bytes view(std::uint64_t offset, std::size_t size) {
    const std::uint64_t into = offset - begin_;
    if (offset >= begin_ && into <= length_ && size <= length_ - into) return {data_ + into, size};
    return refill(offset, size);
  }

 private:
  Bytes refill(std::uint64_t offset, std::size_t size);

  const Input* input_ = nullptr;
  std::size_t read_ahead_ = 0;
  const std::byte* data_ = nullptr;
  std::uint64_t begin_ = 0, length_ = 0, size_ = 0;
  std::unique_ptr<std::byte[]> buffer_;
  std::size_t capacity_ = 0;
};

}  // namespace vispline
