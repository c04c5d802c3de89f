/// The noise of one sensitive axis: white noise by sample index, a bias that moves on, a digitiser. docs/math/noise.md.
#pragma once

#include <cstdint>
#include <string>

#include "vispline/core/noise.h"
#include "vispline/core/random.h"
#include "vispline/simulate/flicker.h"

namespace vispline {

/// Rounded to a multiple of `quantum` (ties to the even one) and held within +-range; at the limit, the largest
/// multiple of the quantum within the range. 0 switches either off. docs/math/noise.md (11), (12)
double digitise(const NoiseModel& model, double value);

/// What a sample draws.
struct AxisNormals {
  double white = 0.0;
  double walk = 0.0;
};

class AxisNoise {
 public:
  /// The streams of this axis start with `stream_name`, for instance "imu0/gyroscope/x".
  AxisNoise(const NoiseModel& model, std::uint64_t seed, const std::string& stream_name);

  /// The two standard normal numbers of sample `index`; zeros if the model needs none. Any thread, any order.
  AxisNormals normals(std::uint64_t index) const;

  /// Bias of the current sample: turn-on + random walk + flicker, in the unit of the triad.
  double bias() const { return walk_ + flicker_.value(); }
  /// Moves the bias on by dt seconds, from sample `index` to the next one. In order, once for every sample:
  ///   walk += K sqrt(dt) w                                                             docs/math/noise.md (4)
  void advance(std::uint64_t index, double walk_normal, double dt);

  /// Reading of an axis whose exact value is `exact`, with white noise N / sqrt(averaging time) (2). Without noise the
  /// exact value itself, bit for bit.
  double read(double exact, double bias, double white_normal, double inverse_sqrt_averaging_time) const;

 private:
  NoiseModel model_;
  RandomStream stream_;
  double walk_ = 0.0;
  FlickerProcess flicker_;
};

}  // namespace vispline
