/// The lenses that have a name: one line each. docs/extending.md, A lens.
#pragma once

#include "vispline/sensors/lenses/composed.h"
#include "vispline/sensors/lenses/double_sphere.h"
#include "vispline/sensors/lenses/equidistant.h"
#include "vispline/sensors/lenses/extended_unified.h"
#include "vispline/sensors/lenses/fov.h"
#include "vispline/sensors/lenses/perspective.h"
#include "vispline/sensors/lenses/radtan.h"
#include "vispline/sensors/lenses/unified.h"

namespace vispline::lenses {

using Pinhole = Composed<Perspective, NoDistortion>;
using PinholeRadtan = Composed<Perspective, Radtan>;
using PinholeEquidistant = Composed<Equidistant, RadialPolynomial>;
using PinholeFov = Composed<Perspective, Fov>;
using Omni = Composed<Unified, NoDistortion>;
using OmniRadtan = Composed<Unified, Radtan>;
using DoubleSphereLens = Composed<DoubleSphere, NoDistortion>;
using ExtendedUnifiedLens = Composed<ExtendedUnified, NoDistortion>;

/// Calls `use(Lens{})` with the type that belongs to `model`.
template <class Use>
decltype(auto) with_model(LensModel model, Use&& use) {
  switch (model) {
    case LensModel::kPinhole:
      break;
    case LensModel::kPinholeRadtan:
      return use(PinholeRadtan{});
    case LensModel::kPinholeEquidistant:
      return use(PinholeEquidistant{});
    case LensModel::kPinholeFov:
      return use(PinholeFov{});
    case LensModel::kOmni:
      return use(Omni{});
    case LensModel::kOmniRadtan:
      return use(OmniRadtan{});
    case LensModel::kDoubleSphere:
      return use(DoubleSphereLens{});
    case LensModel::kExtendedUnified:
      return use(ExtendedUnifiedLens{});
  }
  return use(Pinhole{});
}

}  // namespace vispline::lenses
