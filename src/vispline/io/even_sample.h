/// Evenly spaced values of a stream of unknown length: all of them while they are few, then every 2nd, 4th, ...
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vispline {

/// Between kMost / 2 and kMost values of a longer stream, in order. Depends on nothing but the stream.
template <class Value>
class EvenSample {
 public:
  static constexpr std::size_t kMost = std::size_t{1} << 17;

  void add(Value value) {
    if ((count_++ & (stride_ - 1)) != 0) return;
    values_.push_back(value);
    if (values_.size() == kMost) thin_out();
  }

  const std::vector<Value>& values() const { return values_; }
  bool empty() const { return values_.empty(); }
  /// Values that were added.
  std::uint64_t count() const { return count_; }

 private:
  void thin_out() {
    for (std::size_t i = 0; i < kMost / 2; ++i) values_[i] = values_[2 * i];
    values_.resize(kMost / 2);
    stride_ *= 2;
  }

  std::vector<Value> values_;
  std::uint64_t count_ = 0;
  std::uint64_t stride_ = 1;
};

/// The value below which `part` of the values are; there must be one.
template <class Value>
Value quantile(std::vector<Value> values, double part) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace vispline
