/// Pictures of a scene as a real shutter takes them: every line at its own time, blurred over its exposure.
/// docs/math/rendering.md, Images.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "vispline/sensors/image.h"
#include "vispline/simulate/scene.h"
#include "vispline/trajectory/trajectory.h"

namespace vispline {

struct RenderOptions {
  int supersampling = 2;    ///< rays a pixel in each direction
  int most_exposures = 16;  ///< instants over which a line's exposure is averaged; fewer where less than 1 px moves
  double gain = 1.0;        ///< of light and of read noise
  double vignette = 0.0;    ///< part of the light that is missing in the corners, 0 to 1
  double read_sigma_grey = 1.0;    ///< standard deviation of the noise of a pixel, grey levels at gain 1
  double background_grey = 100.0;  ///< where there is no surface
  std::uint64_t seed = 0;          ///< of the noise; its stream depends on the camera's name and the stamp
  std::size_t threads = 1;         ///< does not change a byte of the image
};

class Renderer {
 public:
  /// Throws Error(kUsage) for an invalid scene, camera or option.
  Renderer(Scene scene, Camera camera, RenderOptions options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// The frame stamped `stamp` on the camera's clock: its line L is exposed around stamp + delay_s of L, on the body's
  /// clock. Pixels outside the lens's domain are 0. Empty if the trajectory does not span all exposures.
  std::optional<GreyImage> render(const Trajectory& trajectory, Time stamp) const;
  /// Begin of the first and end of the last exposure, as the body's clock shows them.
  TimeSpan exposed(Time stamp) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace vispline
