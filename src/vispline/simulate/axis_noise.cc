#include "vispline/simulate/axis_noise.h"

#include <algorithm>
#include <cmath>

namespace vispline {
namespace {
/// range / quantum is rounded down, but not for the last digit: 0.3 / 0.1 is 3.
constexpr double kRoundingSlack = 1e-9;
}  // namespace

double digitise(const NoiseModel& model, double value) {
  double limit = model.range;
  if (model.quantum > 0.0) {
    value = model.quantum * std::nearbyint(value / model.quantum);
    limit = model.quantum * std::floor(model.range / model.quantum * (1.0 + kRoundingSlack));
  }
  return model.range > 0.0 ? std::clamp(value, -limit, limit) : value;
}

AxisNoise::AxisNoise(const NoiseModel& model, std::uint64_t seed, const std::string& stream_name)
    : model_(model), stream_(seed, stream_name), flicker_(model.bias_instability, seed, stream_name + "/flicker") {
  if (model.turn_on_bias > 0.0) {
    walk_ = model.turn_on_bias * RandomStream(seed, stream_name + "/turn_on").normal(0);
  }
}

AxisNormals AxisNoise::normals(std::uint64_t index) const {
  if (model_.white == 0.0 && model_.walk == 0.0) return {};
  const auto [white, walk] = stream_.normal_pair(index);
  return {white, walk};
}

void AxisNoise::advance(std::uint64_t index, double walk_normal, double dt) {
  if (model_.walk > 0.0) walk_ += model_.walk * std::sqrt(dt) * walk_normal;
  flicker_.advance(index, dt);
}

double AxisNoise::read(double exact, double bias, double white_normal, double inverse_sqrt_averaging_time) const {
  double value = exact;
  if (bias != 0.0) value += bias;
  if (model_.white > 0.0) value += model_.white * inverse_sqrt_averaging_time * white_normal;
  return digitise(model_, value);
}

}  // namespace vispline
