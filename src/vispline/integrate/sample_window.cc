#include "vispline/integrate/sample_window.h"

#include <algorithm>

namespace vispline {
namespace {

/// First of the `points` samples that surround step `index` best, within a signal of `size` samples.
std::size_t first_point(std::size_t index, std::size_t points, std::size_t size) {
  const std::size_t before = points / 2 - 1;
  return std::min(index > before ? index - before : 0, size - points);
}

}  // namespace

ImuSample SampleWindow::interpolate(double u, std::size_t points) const {
  points = std::min(points, imu_->size());
  const std::size_t begin = first_point(index_, points, imu_->size());
  const Time step_start = imu_->time[index_];
  const auto node = [&](std::size_t j) { return to_seconds(imu_->time[begin + j] - step_start); };
  const double t = u * dt();
  ImuSample sum;
  for (std::size_t j = 0; j < points; ++j) {
    double weight = 1.0;
    for (std::size_t k = 0; k < points; ++k) {
      if (k != j) weight *= (t - node(k)) / (node(j) - node(k));
    }
    sum.gyro += weight * imu_->value[begin + j].gyro;
    sum.accel += weight * imu_->value[begin + j].accel;
  }
  return sum;
}

}  // namespace vispline
