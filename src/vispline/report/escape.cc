#include "vispline/report/escape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace vispline::report {
namespace {

struct CodePoint {
  std::uint32_t value;
  std::size_t length;  ///< bytes
};

struct Interval {
  std::uint32_t first;
  std::uint32_t last;
};

/// Characters that a reader cannot see or that reorder what is seen.
constexpr std::array<Interval, 12> kHidden{{{0x00, 0x1f},
                                            {0x7f, 0x9f},
                                            {0xad, 0xad},
                                            {0x61c, 0x61c},
                                            {0x180e, 0x180e},
                                            {0x200b, 0x200f},
                                            {0x2028, 0x202e},
                                            {0x2060, 0x206f},
                                            {0xfeff, 0xfeff},
                                            {0xfff9, 0xfffb},
                                            {0xfffe, 0xffff},
                                            {0xe0000, 0xe007f}}};

constexpr std::string_view kEllipsis = "…";

/// The code point at the start of a non-empty text, or nothing where the bytes are not shortest-form UTF-8.
std::optional<CodePoint> decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return CodePoint{lead, 1};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return std::nullopt;
  std::uint32_t value = lead & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return std::nullopt;
    value = (value << 6) | (byte(i) & 0x3f);
  }
  constexpr std::array<std::uint32_t, 5> kSmallest{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = value >= 0xd800 && value <= 0xdfff;
  if (value < kSmallest[length] || value > 0x10ffff || surrogate) return std::nullopt;
  return CodePoint{value, length};
}

bool hidden(std::uint32_t value) {
  return std::any_of(kHidden.begin(), kHidden.end(),
                     [&](const Interval& i) { return i.first <= value && value <= i.last; });
}

void append_hex(std::string& out, std::string_view prefix, std::uint32_t value, int digits) {
  out += prefix;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) out += "0123456789ABCDEF"[(value >> shift) & 0xf];
}

/// Of the wider sans-serif fonts; others need less.
double width_em(std::uint32_t value) {
  if (value >= 0x1100) return value >= 0x2000 && value < 0x2e80 ? 0.84 : 1.0;
  if (value == 'i' || value == 'l' || value == 'j' || value == '.' || value == ',' || value == ' ') return 0.32;
  if (value == 'm' || value == 'w' || value == 'M' || value == 'W') return 0.95;
  const bool wide = (value >= '0' && value <= '9') || (value >= 'A' && value <= 'Z') || value == 0xd7;
  return wide ? 0.68 : 0.6;
}

/// Byte length of the longest prefix of a visible text no wider than max_em.
std::size_t prefix_within(std::string_view visible, double max_em) {
  double width = 0.0;
  std::size_t at = 0;
  while (at < visible.size()) {
    const auto point = decode(visible.substr(at)).value_or(CodePoint{'?', 1});
    width += width_em(point.value);
    if (width > max_em) break;
    at += point.length;
  }
  return at;
}

}  // namespace

std::string visible_text(std::string_view untrusted) {
  std::string out;
  while (!untrusted.empty()) {
    const auto point = decode(untrusted);
    const std::size_t length = point ? point->length : 1;
    if (!point) {
      append_hex(out, "\\x", static_cast<unsigned char>(untrusted[0]), 2);
    } else if (hidden(point->value)) {
      append_hex(out, "\\u", point->value, point->value > 0xffff ? 5 : 4);
    } else {
      out += untrusted.substr(0, length);
    }
    untrusted.remove_prefix(length);
  }
  return out;
}

std::string escaped(std::string_view untrusted) {
  std::string out;
  for (const char c : visible_text(untrusted)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

double text_width_em(std::string_view visible) {
  double width = 0.0;
  while (!visible.empty()) {
    const auto point = decode(visible).value_or(CodePoint{'?', 1});
    width += width_em(point.value);
    visible.remove_prefix(point.length);
  }
  return width;
}

std::string shortened(std::string_view untrusted, double max_em) {
  const std::string text = visible_text(untrusted);
  if (prefix_within(text, max_em) == text.size()) return text;
  const double room = max_em - text_width_em(kEllipsis);
  return room < 0.0 ? std::string() : text.substr(0, prefix_within(text, room)) + std::string(kEllipsis);
}

}  // namespace vispline::report
