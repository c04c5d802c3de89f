#include "vispline/sensors/camera.h"

#include <cmath>
#include <string_view>

#include "vispline/core/error.h"

namespace vispline {
namespace {

class Checker {
 public:
  explicit Checker(const Camera& camera) : camera_(camera) {}

  void check(bool holds, std::string_view field, std::string_view expected) const {
    if (holds) return;
    throw Error(ExitCode::kUsage, {.code = "E-CONFIG",
                                   .message = "camera " + quoted(camera_.name) + ": " + std::string(field) +
                                              " must be " + std::string(expected),
                                   .where = "",
                                   .effect = "nothing done",
                                   .next = "correct this value of the camera"});
  }

  void check_lens() const {
    const auto& [model, params] = camera_.lens;
    const int count = lens_params(model);
    check(params.size() == count, "lens",
          std::string(lens_name(model)) + " with " + std::to_string(count) + " parameters");
    for (int i = 0; i < count; ++i) {
      const std::string_view name = lens_param_name(model, i);
      const double value = params[i];
      check(std::isfinite(value), name, "finite");
      if (name == "fu" || name == "fv" || name == "beta") check(value > 0.0, name, "positive");
      if (name == "alpha") check(value >= 0.0 && value <= 1.0, name, "between 0 and 1");
      if (name == "xi") check(value > -1.0, name, "above -1");
      if (name == "w") check(value >= 0.0 && value < 3.14159, name, "an angle of view between 0 and pi, rad");
    }
  }

  void check_pose() const {
    const Pose& pose = camera_.T_c_b;
    check(pose.p.allFinite() && pose.R.allFinite(), "T_c_b", "finite");
    const double error = (pose.R * pose.R.transpose() - Matrix3d::Identity()).cwiseAbs().maxCoeff();
    check(error < 1e-6 && pose.R.determinant() > 0.0, "the rotation of T_c_b", "orthonormal and right-handed");
  }

  void check_shutter() const {
    const Shutter& shutter = camera_.shutter;
    const double frame_s = 1.0 / camera_.rate_hz;
    check(std::isfinite(shutter.line_delay_s) && shutter.line_delay_s >= 0.0, "line_delay", "finite and not negative");
    check(shutter.line_delay_s * (shutter.lines(camera_.resolution_px) - 1) < frame_s, "line_delay",
          "short enough to read the image before the next one begins");
    check(std::isfinite(shutter.exposure_s) && shutter.exposure_s >= 0.0, "exposure", "finite and not negative");
  }

 private:
  const Camera& camera_;
};

}  // namespace

void require_valid(const Camera& camera) {
  const Checker checker(camera);
  checker.check(!camera.name.empty(), "name", "not empty");
  checker.check(std::isfinite(camera.rate_hz) && camera.rate_hz > 0.0, "rate_hz", "finite and positive");
  checker.check(camera.resolution_px[0] > 0 && camera.resolution_px[1] > 0, "resolution_px", "positive");
  checker.check_lens();
  checker.check_pose();
  checker.check(std::isfinite(camera.time_offset_s), "time_offset", "finite");
  checker.check_shutter();
  checker.check(std::isfinite(camera.pixel_sigma_px) && camera.pixel_sigma_px >= 0.0, "pixel_sigma_px",
                "finite and not negative");
}

}  // namespace vispline
