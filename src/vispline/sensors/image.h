/// One picture of a camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vispline {

/// 8-bit grey, linear in light, row by row from the upper left.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> grey{};  ///< width * height

  std::uint8_t& at(int x, int y) { return grey[index(x, y)]; }
  std::uint8_t at(int x, int y) const { return grey[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

}  // namespace vispline
