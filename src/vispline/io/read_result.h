/// What every reader hands back: the value, how many records it stands for, and what was odd.
#pragma once

#include <cstdint>
#include <string>

#include "vispline/core/error.h"

namespace vispline {

template <class Value>
struct ReadResult {
  Value value;
  ReadCounts counts;
  Diagnostics diagnostics;
  std::string format;     ///< kName of the format that was read; of a recording the type of its messages
  std::int64_t late = 0;  ///< rows that came out of order, and were sorted in
};

}  // namespace vispline
