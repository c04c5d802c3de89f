/// The pictures of the tag family tag36h11 with the border that Kalibr's boards have.
#pragma once

#include <array>

namespace vispline {

inline constexpr int kTagCells = 10;  ///< 6 x 6 bits within 2 cells of black

/// [row from above][column from the left]; true: white.
using TagCells = std::array<std::array<bool, kTagCells>, kTagCells>;

/// Number of tags in the family.
int tag36h11_count();
/// Upright, as Kalibr prints it. Precondition: 0 <= id < tag36h11_count().
TagCells tag36h11_cells(int id);

}  // namespace vispline
