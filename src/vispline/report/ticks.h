/// Where an axis is marked and what is written there.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vispline::report {

/// lo < hi; on a logarithmic axis 0 < lo.
struct Range {
  double lo = 0.0;
  double hi = 1.0;
};

/// "0.25", or "2.5×10" with an exponent to be raised; minus signs are U+2212.
struct TickLabel {
  std::string text;
  std::optional<int> exponent;
};

struct Tick {
  double value;
  TickLabel label;
};

struct Ticks {
  std::vector<Tick> major;    ///< ascending, inside the range
  std::vector<double> minor;  ///< unlabelled, inside the range
};

/// 4 to 9 ticks at multiples of 1, 2 or 5 times a power of ten (2.5 where none of them gives that many), as near to
/// `target` in number as that allows. |lo|, |hi| at most 1e300 and the range not below 1e-12 of them.
Ticks linear_ticks(Range range, int target);

/// 3 to 9 ticks: decades, every n-th decade, with few decades their digits, and far inside one decade linear_ticks.
Ticks log_ticks(Range range);

}  // namespace vispline::report
