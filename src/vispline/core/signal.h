/// A signal: values at strictly increasing stamps.
#pragma once

#include <cstddef>
#include <vector>

#include "vispline/core/time.h"

namespace vispline {

template <class Value>
struct Signal {
  std::vector<Time> time;    ///< strictly increasing
  std::vector<Value> value;  ///< as many as stamps

  std::size_t size() const { return time.size(); }
  bool empty() const { return time.empty(); }
  void reserve(std::size_t n) {
    time.reserve(n);
    value.reserve(n);
  }
  void push_back(Time t, const Value& v) {
    time.push_back(t);
    value.push_back(v);
  }
  /// Precondition: not empty.
  TimeSpan span() const { return {time.front(), time.back()}; }
};

}  // namespace vispline
