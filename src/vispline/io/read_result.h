/// What every reader hands back: the value, how many records it stands for, and what was odd.
#pragma once

#include <string>

#include "vispline/core/error.h"

namespace vispline {

template <class Value>
struct ReadResult {
  Value value;
  ReadCounts counts;
  Diagnostics diagnostics;
  std::string format;  ///< kName of the format that was read
};

}  // namespace vispline
