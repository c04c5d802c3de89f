#include "vispline/allan/factors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "vispline/core/error.h"

namespace vispline {
namespace {

/// Octaves below this one hold fewer integers than the grid has factors.
constexpr int kBaseOctave = 5;

std::vector<std::int64_t> octaves(std::int64_t largest) {
  std::vector<std::int64_t> factors;
  for (std::int64_t m = 1; m <= largest; m *= 2) factors.push_back(m);
  return factors;
}

std::vector<std::int64_t> decades(std::int64_t largest) {
  std::vector<std::int64_t> factors;
  for (std::int64_t power = 1; power <= largest; power *= 10) {
    for (const std::int64_t digit : {1, 2, 4}) {
      if (digit * power <= largest) factors.push_back(digit * power);
    }
  }
  return factors;
}

/// `count` factors in even ratio; those that round to the same integer are one.
std::vector<std::int64_t> spread(std::int64_t count, std::int64_t largest) {
  std::vector<std::int64_t> factors;
  const double step = count > 1 ? std::log(static_cast<double>(largest)) / static_cast<double>(count - 1) : 0.0;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto m = std::min<std::int64_t>(std::llround(std::exp(step * static_cast<double>(i))), largest);
    if (factors.empty() || m > factors.back()) factors.push_back(m);
  }
  return factors;
}

std::vector<std::int64_t> every(std::int64_t largest) {
  std::vector<std::int64_t> factors(static_cast<std::size_t>(largest));
  for (std::int64_t m = 1; m <= largest; ++m) factors[static_cast<std::size_t>(m - 1)] = m;
  return factors;
}

}  // namespace

std::vector<std::int64_t> log_factors(std::int64_t largest) {
  std::vector<std::int64_t> factors;
  for (int octave = 0;; ++octave) {
    for (int q = 0; q < kFactorsPerOctave; ++q) {
      const double mantissa = std::exp2(static_cast<double>(q) / kFactorsPerOctave);
      const int shift = std::max(octave - kBaseOctave, 0);
      const std::int64_t m = std::llround(mantissa * std::exp2(octave - shift)) << shift;
      if (m > largest) return factors;
      if (factors.empty() || m > factors.back()) factors.push_back(m);
    }
  }
}

std::vector<std::int64_t> averaging_factors(std::string_view grid, std::int64_t readings, Deviation kind) {
  // The largest factor a single difference fits into; a total deviation is defined up to the whole record.
  std::int64_t largest = kind == Deviation::kTotdev ? readings / 2 : readings;
  while (largest > 0 && points_needed(kind, largest) > readings + 1) {
    largest = std::min(largest - 1, largest * (readings + 1) / points_needed(kind, largest));
  }
  if (grid == "log") return log_factors(largest);
  if (grid == "octave") return octaves(largest);
  if (grid == "decade") return decades(largest);
  if (grid == "all") return every(largest);
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(grid.data(), grid.data() + grid.size(), count);
  require(error == std::errc() && end == grid.data() + grid.size() && count >= 1,
          "log, octave, decade, all or a number of at least 1 as the grid of taus");
  return largest < 1 ? std::vector<std::int64_t>{} : spread(count, largest);
}

}  // namespace vispline
