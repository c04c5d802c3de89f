/// What a fuzz target asserts, in every kind of build.
#pragma once

#include <cstdlib>

namespace vispline::fuzz {

inline void must(bool condition) {
  if (!condition) std::abort();
}

}  // namespace vispline::fuzz
