#include "vispline/estimate/state.h"

#include <algorithm>
#include <cmath>

namespace vispline {

BiasWalk::Place BiasWalk::locate(const Instant& at) const {
  const double x = (to_seconds(at.time - begin) + at.extra_s) / to_seconds(spacing);
  const double last = static_cast<double>(node.size()) - 1.0;
  const double first = std::clamp(std::floor(x), 0.0, last - 1.0);
  return {static_cast<std::size_t>(first), std::clamp(x - first, 0.0, 1.0)};
}

Vector6d BiasWalk::at(const Instant& at) const {
  if (node.empty()) return Vector6d::Zero();
  const Place place = locate(at);
  return (1.0 - place.u) * node[place.first] + place.u * node[place.first + 1];
}

State& State::operator=(const State& other) {
  if (this == &other) return *this;
  curve = other.curve ? other.curve->clone() : nullptr;
  rig = other.rig;
  g_w = other.g_w;
  bias_walks = other.bias_walks;
  landmarks = other.landmarks;
  references = other.references;
  return *this;
}

}  // namespace vispline
