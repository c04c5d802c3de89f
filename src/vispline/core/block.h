/// Parameter blocks: what a solver, a YAML key, a report row and a Python attribute have to know about a parameter.
/// docs/conventions.md, Perturbations.
#pragma once

#include <cstddef>
#include <string_view>

namespace vispline {

/// The space a block lives in; it decides how many scalars are stored and how the block is perturbed.
enum class Space {
  kEuclidean,  ///< any number of scalars, x + delta; a matrix is stored and perturbed column by column
  kSO3,        ///< rotation matrix, 9 scalars; R exp(delta)
  kSE3,        ///< Pose, 12 scalars (R by columns, p); T exp(delta), delta = (translation, rotation)
  kSphere,     ///< unit vector, 3 scalars; moves in its tangent plane
};

/// One block of a model's parameters. A model lists its blocks in `kBlocks`, in the order of `Params::tie()`.
struct Block {
  std::string_view name;  ///< also the YAML key
  int size = 0;           ///< scalars as stored
  Space space = Space::kEuclidean;
  std::string_view unit;  ///< of each scalar; "1" for a pure number, "m, rad" for a pose

  /// Scalars of a perturbation.
  constexpr int tangent_size() const {
    switch (space) {
      case Space::kSO3:
        return 3;
      case Space::kSE3:
        return 6;
      case Space::kSphere:
        return 2;
      case Space::kEuclidean:
        break;
    }
    return size;
  }
};

/// First tangent column of block `index` among all columns; with index = number of blocks, the number of columns.
template <class Blocks>
constexpr int tangent_offset(const Blocks& blocks, std::size_t index) {
  int offset = 0;
  for (std::size_t i = 0; i < index; ++i) offset += blocks[i].tangent_size();
  return offset;
}

/// Index of the block called `name`, or blocks.size() if there is none.
template <class Blocks>
constexpr std::size_t block_index(const Blocks& blocks, std::string_view name) {
  std::size_t i = 0;
  while (i < blocks.size() && blocks[i].name != name) ++i;
  return i;
}

}  // namespace vispline
