/// What every reader of signals owes, whatever the bytes.
#pragma once

#include <cmath>

#include "memory_file.h"
#include "vispline/io/read.h"

namespace vispline::fuzz {

/// Counts add up, stamps strictly increase. False: the reader refused the file with an Error.
template <class Value, class Read>
bool read_with(const Read& read, ReadResult<Signal<Value>>& result) {
  try {
    result = read();
  } catch (const Error& error) {
    must(error.diagnostic().code.starts_with("E-"));
    return false;
  }
  must(result.counts.read == result.counts.kept + result.counts.dropped_total());
  must(static_cast<std::size_t>(result.counts.kept) == result.value.size());
  must(result.value.time.size() == result.value.value.size());
  for (std::size_t i = 1; i < result.value.size(); ++i) must(result.value.time[i - 1] < result.value.time[i]);
  return true;
}

/// The same poses, as text holds them.
inline void must_be_same(const Signal<Pose>& a, const Signal<Pose>& b) {
  must(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    must(a.value[i].p == b.value[i].p);
    must((a.value[i].R - b.value[i].R).cwiseAbs().maxCoeff() < 1e-9);
  }
}

}  // namespace vispline::fuzz
