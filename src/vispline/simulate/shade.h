/// Grey of the pixels of a bundle at one instant.
#pragma once

#include <span>
#include <vector>

#include "vispline/simulate/ray_table.h"
#include "vispline/simulate/surface_view.h"

namespace vispline {

struct Shading {
  int supersampling = 2;
  double background_grey = 0.0;
};

/// Adds the grey of place k of the line to grey[k]; places that see nothing are left alone. `views` are those of all
/// surfaces from the camera at that instant.
void shade_line(const RayTable& rays, int line, std::span<const SurfaceView> views, const Shading& shading,
                std::span<double> grey);

}  // namespace vispline
