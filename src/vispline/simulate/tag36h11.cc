#include "vispline/simulate/tag36h11.h"

#include <apriltag/tag36h11.h>

#include <cstdint>
#include <memory>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr std::uint32_t kBorderThere = 1;  // cells of black around the bits in the family's own drawing
constexpr std::uint32_t kBorderHere = 2;

using Family = std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)>;
Family make_family() { return {tag36h11_create(), &tag36h11_destroy}; }

}  // namespace

int tag36h11_count() { return static_cast<int>(make_family()->ncodes); }

TagCells tag36h11_cells(int id) {
  const Family family = make_family();
  require(id >= 0 && id < static_cast<int>(family->ncodes), "the number of a tag of the family");
  const std::uint64_t code = family->codes[id];
  TagCells cells{};
  for (std::uint32_t bit = 0; bit < family->nbits; ++bit) {
    const bool white = (code >> (family->nbits - 1 - bit) & 1u) != 0;
    cells.at(family->bit_y[bit] - kBorderThere + kBorderHere).at(family->bit_x[bit] - kBorderThere + kBorderHere) =
        white;
  }
  return cells;
}

}  // namespace vispline
