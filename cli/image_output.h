/// Rendered images of one camera as a EuRoC folder: mav0/NAME/data.csv and data/STAMP.png.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "vispline/files/output_file.h"
#include "vispline/simulate/feature_simulation.h"
#include "vispline/simulate/render.h"

namespace vispline::cli {

/// Throws E-ARGUMENT for a scene without surfaces.
void require_surfaces(const Scene& scene);

class ImageOutput {
 public:
  /// Precondition: a scene with surfaces.
  ImageOutput(const std::string& folder, const Scene& scene, const Camera& camera, const RenderOptions& render,
              OutputOptions options);
  /// The image of a frame; empty, and nothing is written, if the trajectory does not cover all its exposures.
  std::optional<GreyImage> write(const Trajectory& trajectory, const FrameInstant& instant);
  /// Gives the list of images its name.
  void publish();
  std::size_t outside() const { return outside_; }

 private:
  std::string folder_;
  Renderer renderer_;
  OutputOptions options_;
  OutputFile list_;
  std::size_t outside_ = 0;
};

}  // namespace vispline::cli
