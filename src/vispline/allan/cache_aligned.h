/// Memory that starts at a cache line.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace vispline {

/// For std::vector. A wide load from an address that is a multiple of its size never straddles two cache lines.
template <class T>
struct CacheAligned {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, kAlignment); }
  friend bool operator==(const CacheAligned&, const CacheAligned&) { return true; }
};

/// Phase points of a series.
using Phase = std::vector<double, CacheAligned<double>>;

}  // namespace vispline
