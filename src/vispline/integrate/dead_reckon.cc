#include "vispline/integrate/dead_reckon.h"

#include <algorithm>
#include <functional>

#include "vispline/core/error.h"
#include "vispline/integrate/rules.h"

namespace vispline {

Signal<NavState> dead_reckon(const ImuSignal& imu, const NavState& start, std::string_view rule, const Vector3d& g_w) {
  const StepFunction step = integration_rule(rule).step;
  require(std::ranges::adjacent_find(imu.time, std::greater_equal<>()) == imu.time.end(),
          "IMU stamps that strictly increase");
  Signal<NavState> states;
  states.time = imu.time;
  states.value.reserve(imu.size());
  if (!imu.empty()) states.value.push_back(start);
  for (std::size_t i = 0; i + 1 < imu.size(); ++i) {
    states.value.push_back(step(states.value.back(), SampleWindow(imu, i), g_w));
  }
  return states;
}

Signal<Pose> poses(const Signal<NavState>& states) {
  Signal<Pose> result;
  result.time = states.time;
  result.value.reserve(states.size());
  for (const NavState& state : states.value) result.value.push_back(state.T_w_b());
  return result;
}

}  // namespace vispline
