/// What a type must offer to be a sensor on the body. A model is written once, `predict`, over the scalar: double
/// simulates, a dual number differentiates. A wrong model fails at `static_assert(Sensor<Model>)`, which names the
/// requirement that is not met.
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <utility>

#include "vispline/core/block.h"
#include "vispline/core/body_state.h"
#include "vispline/sensors/linearization.h"

namespace vispline {

namespace detail {

/// Stored scalars and space of a parameter, by its type.
template <class Element>
struct ElementOf;
template <>
struct ElementOf<double> {
  static constexpr int kSize = 1;
  static constexpr Space kSpace = Space::kEuclidean;
};
template <int kRows, int kCols>
struct ElementOf<Eigen::Matrix<double, kRows, kCols>> {
  static constexpr int kSize = kRows * kCols;
  static constexpr Space kSpace = Space::kEuclidean;
};
template <>
struct ElementOf<Pose> {
  static constexpr int kSize = 12;
  static constexpr Space kSpace = Space::kSE3;
};

template <class Model>
using TieOf = decltype(std::declval<typename Model::template Params<double>&>().tie());

template <class Model>
constexpr bool blocks_match_params() {
  if constexpr (Model::kBlocks.size() != std::tuple_size_v<TieOf<Model>>) {
    return false;
  } else {
    return []<std::size_t... i>(std::index_sequence<i...>) {
      const auto matches = []<class E>(const Block& block, const E*) {
        return block.size == ElementOf<E>::kSize && block.space == ElementOf<E>::kSpace;
      };
      return (matches(Model::kBlocks[i],
                      static_cast<std::remove_cvref_t<std::tuple_element_t<i, TieOf<Model>>>*>(nullptr)) &&
              ...);
    }
    (std::make_index_sequence<Model::kBlocks.size()>());
  }
}

}  // namespace detail

/// `Sample`: what one reading is; `kName`: what the model is called in files.
template <class Model>
concept HasSampleAndName = requires {
  typename Model::Sample;
  { Model::kName } -> std::convertible_to<std::string_view>;
};

/// `Params<T>`: default-constructible parameters with `tie()`, references to the blocks in the order of kBlocks.
template <class Model>
concept HasParams = std::default_initializable<typename Model::template Params<double>> &&
    requires(typename Model::template Params<double> params) {
  params.tie();
};

/// `kBlocks`: array of Block; `kParams`: tangent columns of all blocks.
template <class Model>
concept HasBlocks = requires {
  { Model::kBlocks[0] } -> std::convertible_to<Block>;
}
&&Model::kParams == tangent_offset(Model::kBlocks, Model::kBlocks.size());

/// Each block of kBlocks has the size and the space of the element that tie() has at its place.
template <class Model>
concept BlocksMatchParams = detail::blocks_match_params<Model>();

/// `predict(state, params, g_w)`: the exact reading, without noise.
template <class Model>
concept HasPredict = requires(const BodyState& state, const typename Model::template Params<double>& params,
                              const Vector3d& g_w) {
  { Model::template predict<double>(state, params, g_w) } -> std::convertible_to<typename Model::Sample>;
};

template <class Model>
concept Sensor =
    HasSampleAndName<Model> && HasParams<Model> && HasBlocks<Model> && BlocksMatchParams<Model> && HasPredict<Model>;

/// A sensor with hand-written derivatives; `state_rate` is the time derivative of the state's tangent.
template <class Model>
concept LinearizedSensor = Sensor<Model> &&
    requires(const BodyState& state, const BodyTangent& state_rate,
             const typename Model::template Params<double>& params, const Vector3d& g_w) {
  {
    Model::linearize(state, state_rate, params, g_w)
    } -> std::same_as<Linearization<Model::Sample::RowsAtCompileTime, Model::kParams>>;
};

}  // namespace vispline
