#include "vispline/sensors/lens.h"

#include <Eigen/LU>

#include "vispline/core/error.h"
#include "vispline/sensors/lenses/models.h"

namespace vispline {
namespace {

/// Calls `use(Model{})` after checking that it has as many parameters as were given.
template <class Use>
auto with_params(const Lens& lens, Use&& use) {
  return lenses::with_model(lens.model, [&]<class Model>(Model model) {
    if (lens.params.size() != Model::kNumParams) require(false, "as many lens parameters as the model has");
    return use(model);
  });
}

}  // namespace

std::optional<Vector2d> Lens::project(const Vector3d& point_c) const {
  return with_params(*this,
                     [&]<class Model>(Model) { return Model::template project<double>(params.data(), point_c); });
}

std::optional<LensProjection> Lens::linearize(const Vector3d& point_c) const {
  return with_params(*this, [&]<class Model>(Model) { return Model::linearize(params.data(), point_c); });
}

std::optional<Vector3d> Lens::unproject(const Vector2d& px) const {
  return with_params(*this, [&]<class Model>(Model) { return Model::unproject(params.data(), px); });
}

std::optional<LensRay> Lens::linearize_ray(const Vector2d& px) const {
  const std::optional<Vector3d> bearing_c = unproject(px);
  if (!bearing_c) return std::nullopt;
  const std::optional<LensProjection> forward = linearize(*bearing_c);
  if (!forward) return std::nullopt;
  // project() depends on the direction only, so that d_point bearing = 0: its pseudo-inverse leaves the length alone.
  LensRay ray;
  ray.bearing_c = *bearing_c;
  ray.d_px = forward->d_point.transpose() * lenses::Matrix2d(forward->d_point * forward->d_point.transpose()).inverse();
  ray.d_params = -ray.d_px * forward->d_params;
  return ray;
}

int lens_params(LensModel model) {
  return lenses::with_model(model, []<class Model>(Model) { return Model::kNumParams; });
}

std::string_view lens_name(LensModel model) {
  switch (model) {
    case LensModel::kPinhole:
      break;
    case LensModel::kPinholeRadtan:
      return "pinhole-radtan";
    case LensModel::kPinholeEquidistant:
      return "pinhole-equidistant";
    case LensModel::kPinholeFov:
      return "pinhole-fov";
    case LensModel::kOmni:
      return "omni";
    case LensModel::kOmniRadtan:
      return "omni-radtan";
    case LensModel::kDoubleSphere:
      return "ds";
    case LensModel::kExtendedUnified:
      return "eucm";
  }
  return "pinhole";
}

std::string_view lens_param_name(LensModel model, int index) {
  require(index >= 0 && index < lens_params(model), "the index of a lens parameter");
  return lenses::with_model(model, [&]<class Model>(Model) { return Model::param_name(index); });
}

}  // namespace vispline
