/// Lenses for tests: a plausible one of each model, and the same with every parameter moved.
#pragma once

#include <array>
#include <initializer_list>
#include <ostream>

#include "vispline/sensors/jacobian_testing.h"
#include "vispline/sensors/lens.h"

namespace vispline::testing {

inline constexpr std::array<LensModel, 8> kLensModels{
    LensModel::kPinhole, LensModel::kPinholeRadtan, LensModel::kPinholeEquidistant, LensModel::kPinholeFov,
    LensModel::kOmni,    LensModel::kOmniRadtan,    LensModel::kDoubleSphere,       LensModel::kExtendedUnified};

inline Lens make_lens(LensModel model, std::initializer_list<double> params) {
  Lens lens{model, LensParams(static_cast<Eigen::Index>(params.size()))};
  Eigen::Index i = 0;
  for (const double value : params) lens.params[i++] = value;
  return lens;
}

inline Lens typical_lens(LensModel model) {
  switch (model) {
    case LensModel::kPinhole:
      break;
    case LensModel::kPinholeRadtan:
      return make_lens(model,
                       {458.654, 457.296, 367.215, 248.375, -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05});
    case LensModel::kPinholeEquidistant:
      return make_lens(model,
                       {190.978, 190.973, 254.931, 256.897, 0.0034823894, 0.00071501, -0.0020532361, 0.00020293673});
    case LensModel::kPinholeFov:
      return make_lens(model, {230.0, 231.0, 320.0, 240.0, 0.92});
    case LensModel::kOmni:
      return make_lens(model, {1.4, 750.0, 752.0, 330.0, 245.0});
    case LensModel::kOmniRadtan:
      return make_lens(model, {1.6, 930.0, 931.0, 330.0, 245.0, -0.11, 0.21, 0.0007, -0.0004});
    case LensModel::kDoubleSphere:
      return make_lens(model, {-0.2, 0.59, 160.0, 161.0, 320.0, 240.0});
    case LensModel::kExtendedUnified:
      return make_lens(model, {0.63, 1.1, 270.0, 271.0, 320.0, 240.0});
  }
  return make_lens(LensModel::kPinhole, {460.0, 461.0, 320.0, 240.0});
}

/// Every parameter of the typical lens moved by up to 10 %, focal lengths and centre too.
inline Lens generic_lens(LensModel model, std::uint64_t seed) {
  Lens lens = typical_lens(model);
  Draw draw(seed);
  for (double& value : lens.params) value *= 1.0 + 0.1 * draw();
  return lens;
}

}  // namespace vispline::testing

namespace vispline {
inline void PrintTo(LensModel model, std::ostream* out) { *out << lens_name(model); }
}  // namespace vispline
