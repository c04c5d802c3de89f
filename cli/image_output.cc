#include "image_output.h"

#include "vispline/core/error.h"
#include "vispline/io/euroc_folder.h"
#include "vispline/io/png.h"

namespace vispline::cli {

void require_surfaces(const Scene& scene) {
  require(!scene.surfaces.empty(), "a scene with surfaces for --images: a room or a board");
}

ImageOutput::ImageOutput(const std::string& folder, const Scene& scene, const Camera& camera,
                         const RenderOptions& render, OutputOptions options)
    : folder_(folder + "/mav0/" + camera.name),
      renderer_(scene, camera, render),
      options_(options),
      list_(folder_ + "/data.csv", options) {
  options_.sync = false;
  list_.write(euroc_folder::kImageHeader);
}

std::optional<GreyImage> ImageOutput::write(const Trajectory& trajectory, const FrameInstant& instant) {
  std::optional<GreyImage> image = renderer_.render(trajectory, instant.stamp + from_seconds(instant.clock_delay_s));
  if (!image) {
    ++outside_;
    return image;
  }
  write_file(folder_ + "/data/" + euroc_folder::image_name(instant.stamp), png_bytes(*image), options_);
  list_.write(euroc_folder::image_row(instant.stamp));
  return image;
}

void ImageOutput::publish() { list_.publish(); }

}  // namespace vispline::cli
