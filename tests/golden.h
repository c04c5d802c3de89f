/// Golden files: what the program printed when somebody last read it and found it good. tests/update_golden.sh rewrites
/// them; the diff is read.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "program.h"

namespace vispline {

struct GoldenTolerance {
  double relative = 1e-6;
  double floor = 1e-10;                        ///< of numbers at the level of rounding
  std::map<std::string, double> by_word = {};  ///< floor of all numbers in a line that has this word
};

/// A number, or the text between two of them. Runs of blanks and of dashes count as one: the width of a column of a
/// table depends on the last digit of its numbers.
struct GoldenToken {
  std::string text;
  bool number = false;
};

namespace golden_detail {

inline bool digit(char c) { return c >= '0' && c <= '9'; }

inline bool of_a_word(char c) { return digit(c) || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }

/// End of the number [-+]digits[.digits][e[-+]digits] that begins at `begin`; `begin` itself if there is none, or if
/// it is part of a word or of a dotted version.
inline std::size_t number_end(const std::string& line, std::size_t begin) {
  const auto at = [&](std::size_t i) { return i < line.size() ? line[i] : ' '; };
  const auto past_digits = [&](std::size_t i) {
    while (digit(at(i))) ++i;
    return i;
  };
  const char before = begin == 0 ? ' ' : line[begin - 1];
  if (of_a_word(before) || before == '.' || before == '+' || before == '-') return begin;
  std::size_t end = begin + (at(begin) == '+' || at(begin) == '-');
  if (!digit(at(end))) return begin;
  end = past_digits(end);
  if (at(end) == '.' && digit(at(end + 1))) end = past_digits(end + 1);
  const std::size_t exponent = end + 1 + (at(end + 1) == '+' || at(end + 1) == '-');
  if ((at(end) == 'e' || at(end) == 'E') && digit(at(exponent))) end = past_digits(exponent);
  return of_a_word(at(end)) || at(end) == '.' ? begin : end;
}

inline double parsed(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data() + (text[0] == '+'), text.data() + text.size(), value);
  return value;
}

/// Appends a character of text; of a run of blanks or dashes only the first.
inline void add_text(std::vector<GoldenToken>& tokens, char c) {
  if (tokens.empty() || tokens.back().number) tokens.push_back({"", false});
  std::string& text = tokens.back().text;
  if ((c == ' ' || c == '-') && !text.empty() && text.back() == c) return;
  text += c;
}

inline std::vector<GoldenToken> tokens_of(const std::string& line) {
  std::vector<GoldenToken> tokens;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t end = number_end(line, i);
    if (end > i) {
      tokens.push_back({line.substr(i, end - i), true});
      i = end;
    } else {
      add_text(tokens, line[i++]);
    }
  }
  return tokens;
}

/// One unit of the last printed digit; 0 for integers.
inline double last_digit(const std::string& text) {
  const std::size_t exponent = text.find_first_of("eE"), point = text.find('.');
  if (exponent == std::string::npos && point == std::string::npos) return 0.0;
  const std::string mantissa = text.substr(0, exponent);
  const double decimals = point == std::string::npos ? 0.0 : static_cast<double>(mantissa.size() - point - 1);
  const double power = exponent == std::string::npos ? 0.0 : parsed(text.substr(exponent + 1));
  return std::pow(10.0, power - decimals);
}

/// Trailing zeros are not printed, so the finer of two last digits is the one that was rounded.
inline bool close(const std::string& a, const std::string& b, double relative, double floor) {
  const double x = parsed(a), y = parsed(b), digit_a = last_digit(a), digit_b = last_digit(b);
  if (digit_a == 0.0 && digit_b == 0.0) return a == b;
  const double digit = digit_a == 0.0 ? digit_b : digit_b == 0.0 ? digit_a : std::min(digit_a, digit_b);
  return std::abs(x - y) <= std::max({floor, relative * std::max(std::abs(x), std::abs(y)), 1.01 * digit});
}

inline double floor_of(const std::string& line, const GoldenTolerance& tolerance) {
  double floor = tolerance.floor;
  for (const auto& [word, value] : tolerance.by_word) {
    if (line.find(word) != std::string::npos) floor = std::max(floor, value);
  }
  return floor;
}

inline bool same_line(const std::string& golden, const std::string& line, const GoldenTolerance& tolerance) {
  const auto a = tokens_of(golden), b = tokens_of(line);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const GoldenToken& x, const GoldenToken& y) {
    if (x.number != y.number) return false;
    return x.number ? close(x.text, y.text, tolerance.relative, floor_of(golden, tolerance)) : x.text == y.text;
  });
}

/// The number of a release is not what these files are about.
inline std::string without_version(std::string text) {
  const std::string key = "\"version\": \"";
  const std::size_t begin = text.find(key);
  if (begin == std::string::npos) return text;
  return text.replace(begin + key.size(), text.find('"', begin + key.size()) - begin - key.size(), "...");
}

}  // namespace golden_detail

/// Empty if the texts agree, else the first lines that do not. Empty lines do not count.
inline std::string golden_difference(const std::string& golden, const std::string& text,
                                     const GoldenTolerance& tolerance = {}) {
  const auto filled = [](std::vector<std::string> all) {
    std::erase_if(all, [](const std::string& line) { return line.find_first_not_of(' ') == std::string::npos; });
    return all;
  };
  auto a = filled(lines(golden)), b = filled(lines(text));
  const std::size_t size = std::max(a.size(), b.size());
  a.resize(size, "(no line)");
  b.resize(size, "(no line)");
  for (std::size_t i = 0; i < size; ++i) {
    if (!golden_detail::same_line(a[i], b[i], tolerance)) return "golden:  " + a[i] + "\nprinted: " + b[i];
  }
  return "";
}

inline void expect_golden(const std::string& name, const std::string& printed, const GoldenTolerance& tolerance = {}) {
  const std::string path = std::string(VISPLINE_SOURCE_DIR) + "/tests/golden/" + name;
  const std::string text = golden_detail::without_version(printed);
  if (std::getenv("VISPLINE_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  ASSERT_TRUE(std::filesystem::exists(path)) << path << ": run tests/update_golden.sh";
  EXPECT_EQ(golden_difference(file_bytes(path), text, tolerance), "") << name;
}

}  // namespace vispline
