#include "vispline/sensors/rig.h"

#include <algorithm>

#include "vispline/core/error.h"

namespace vispline {

const Imu* find_imu(const Rig& rig, std::string_view name) {
  const auto found = std::find_if(rig.imus.begin(), rig.imus.end(), [&](const Imu& imu) { return imu.name == name; });
  return found == rig.imus.end() ? nullptr : &*found;
}

void require_valid(const Rig& rig) {
  for (const Imu& imu : rig.imus) {
    require_valid(imu);
    if (find_imu(rig, imu.name) == &imu) continue;
    throw Error(ExitCode::kUsage, {.code = "E-CONFIG",
                                   .message = "two IMUs are called " + quoted(imu.name),
                                   .where = "",
                                   .effect = "nothing done",
                                   .next = "give every sensor of the rig its own name"});
  }
}

}  // namespace vispline
