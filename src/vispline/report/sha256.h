/// The digest that a content security policy names its style by.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vispline::report {

/// SHA-256, FIPS 180-4.
std::array<std::uint8_t, 32> sha256(std::string_view message);

/// RFC 4648 section 4, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace vispline::report
