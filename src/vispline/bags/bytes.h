/// Numbers in byte strings, little-endian unless the name says otherwise, on any machine.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace vispline {

using Bytes = std::span<const std::byte>;

/// The unsigned number at `at`, in the byte order of `order`; sizeof(T) bytes must be there. One load where the machine
/// has that order: compilers do not find it in a loop over bytes.
template <std::endian order, std::unsigned_integral T>
constexpr T load(const std::byte* at) {
  std::array<std::byte, sizeof(T)> bytes;
  std::copy_n(at, sizeof(T), bytes.begin());
  if constexpr (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}
template <std::unsigned_integral T>
constexpr T load_le(const std::byte* at) {
  return load<std::endian::little, T>(at);
}
template <std::unsigned_integral T>
constexpr T load_be(const std::byte* at) {
  return load<std::endian::big, T>(at);
}

/// Appends the bytes of an unsigned number.
template <std::unsigned_integral T>
void store_le(std::string& out, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
}

inline std::string_view as_text(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
inline Bytes as_bytes(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

}  // namespace vispline
