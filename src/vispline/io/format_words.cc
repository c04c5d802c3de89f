#include "vispline/io/format_words.h"

#include <algorithm>
#include <cmath>

#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

double squared(const std::string& cell) {
  double value = 0.0;
  return parse_double(cell, value) == NumberStatus::kOk ? value * value : NAN;
}

bool same_word(std::string_view name, std::string_view word) {
  name = trimmed(name.substr(std::min(name.find_first_not_of("#% \t"), name.size())));
  name = trimmed(name.substr(0, name.find_first_of("[(")));
  return std::equal(name.begin(), name.end(), word.begin(), word.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

}  // namespace

bool names_hold(const std::vector<std::string>& header, std::string_view word) {
  return std::any_of(header.begin(), header.end(), [&](const std::string& name) { return same_word(name, word); });
}

bool sample_holds_quaternions(const TextLayout& layout, std::size_t first) {
  bool seen = false;
  for (const auto& row : layout.sample) {
    if (row.size() < first + 4) continue;
    const double norm2 =
        squared(row[first]) + squared(row[first + 1]) + squared(row[first + 2]) + squared(row[first + 3]);
    if (std::isnan(norm2)) continue;
    if (norm2 < 0.81 || norm2 > 1.21) return false;
    seen = true;
  }
  return seen;
}

bool sample_is_epoch_nanoseconds(const TextLayout& layout) {
  Decimal stamp;
  return !layout.sample.empty() && parse_decimal(layout.sample[0][0], stamp) == NumberStatus::kOk &&
         stamp.whole > 100'000'000'000'000'000;
}

}  // namespace vispline
