#include "vispline/sensors/shutter.h"

namespace vispline {

double Shutter::line(const Vector2d& px, const std::array<int, 2>& resolution_px) const {
  switch (direction) {
    case ReadoutDirection::kDown:
      break;
    case ReadoutDirection::kUp:
      return resolution_px[1] - 1 - px.y();
    case ReadoutDirection::kRight:
      return px.x();
    case ReadoutDirection::kLeft:
      return resolution_px[0] - 1 - px.x();
  }
  return px.y();
}

Vector2d Shutter::line_gradient() const {
  switch (direction) {
    case ReadoutDirection::kDown:
      break;
    case ReadoutDirection::kUp:
      return {0.0, -1.0};
    case ReadoutDirection::kRight:
      return {1.0, 0.0};
    case ReadoutDirection::kLeft:
      return {-1.0, 0.0};
  }
  return {0.0, 1.0};
}

int Shutter::lines(const std::array<int, 2>& resolution_px) const {
  const bool vertical = direction == ReadoutDirection::kDown || direction == ReadoutDirection::kUp;
  return resolution_px[vertical ? 1 : 0];
}

}  // namespace vispline
