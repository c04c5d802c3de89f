/// The fields of one message, one after the other, in the wire format of ROS 1 or in CDR. Nothing is read beyond the
/// bytes of the message.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

#include "vispline/bags/bag.h"

namespace vispline {

/// ROS 1: packed, little-endian, strings u32 length and bytes. CDR: a head of 4 bytes that names the byte order, then
/// fields aligned to their size counted from there, strings u32 length with a NUL at the end. After a field that is not
/// there or is impossible `good()` stays false, and everything read is 0 or empty.
class RosFields {
 public:
  RosFields(Bytes data, Wire wire) : data_(data), cdr_(wire == Wire::kCdr), good_(wire != Wire::kOther) {
    if (cdr_) take_head();
  }

  bool good() const { return good_; }
  std::size_t rest() const { return good_ ? data_.size() - next_ : 0; }
  bool is_cdr() const { return cdr_; }

  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::int32_t i32() { return static_cast<std::int32_t>(number<std::uint32_t>()); }
  double f64() { return std::bit_cast<double>(number<std::uint64_t>()); }
  template <std::size_t n>
  void f64(double (&to)[n]) {
    if (cdr_) align(sizeof(double));
    const Bytes all = take(n * sizeof(double));
    if (!good_) return;
    for (std::size_t i = 0; i < n; ++i) to[i] = std::bit_cast<double>(load<std::uint64_t>(all.data() + 8 * i));
  }

  /// Without the NUL of CDR; a view into the message.
  std::string_view text() {
    std::size_t size = u32();
    const Bytes bytes = take(size);
    if (!good_ || !cdr_ || size == 0) return as_text(bytes);
    if (bytes.back() != std::byte{0}) return fail(), std::string_view();
    return as_text(bytes.first(size - 1));
  }
  /// uint8[]: length and bytes.
  Bytes blob() { return take(u32()); }
  /// The length of a sequence of which each element takes at least `least` bytes; one that cannot fit is a failure.
  std::uint32_t count(std::size_t least) {
    const std::uint32_t elements = u32();
    if (elements > rest() / least) fail();
    return good_ ? elements : 0;
  }
  void fail() { good_ = false; }

 private:
  void take_head() {
    const Bytes head = take(4);
    if (!good_) return;
    good_ = head[0] == std::byte{0} && (head[1] == std::byte{0} || head[1] == std::byte{1});  // plain CDR only
    big_endian_ = head[1] == std::byte{0};
  }
  Bytes take(std::size_t count) {
    if (count > data_.size() - next_) fail();
    if (!good_) return {};
    const Bytes taken = data_.subspan(next_, count);
    next_ += count;
    return taken;
  }
  template <std::unsigned_integral T>
  T number() {
    if (cdr_) align(sizeof(T));
    const Bytes at = take(sizeof(T));
    if (!good_) return 0;
    return load<T>(at.data());
  }
  template <std::unsigned_integral T>
  T load(const std::byte* at) const {
    return big_endian_ ? load_be<T>(at) : load_le<T>(at);
  }
  void align(std::size_t width) { take((width - (next_ - 4) % width) % width); }

  Bytes data_;
  std::size_t next_ = 0;
  bool cdr_;
  bool good_;
  bool big_endian_ = false;
};

}  // namespace vispline
