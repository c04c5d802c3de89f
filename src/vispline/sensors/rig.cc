#include "vispline/sensors/rig.h"

#include <algorithm>
#include <set>
#include <string>

#include "vispline/core/error.h"

namespace vispline {
namespace {

template <class Sensor>
const Sensor* find_named(const std::vector<Sensor>& sensors, std::string_view name) {
  const auto found = std::find_if(sensors.begin(), sensors.end(), [&](const Sensor& s) { return s.name == name; });
  return found == sensors.end() ? nullptr : &*found;
}

}  // namespace

const Imu* find_imu(const Rig& rig, std::string_view name) { return find_named(rig.imus, name); }
const Camera* find_camera(const Rig& rig, std::string_view name) { return find_named(rig.cameras, name); }

void require_valid(const Rig& rig) {
  std::set<std::string_view> names;
  const auto require_new = [&](const std::string& name) {
    if (names.insert(name).second) return;
    throw Error(ExitCode::kUsage, {.code = "E-CONFIG",
                                   .message = "two sensors are called " + quoted(name),
                                   .where = "",
                                   .effect = "nothing done",
                                   .next = "give every sensor of the rig its own name"});
  };
  for (const Imu& imu : rig.imus) {
    require_valid(imu);
    require_new(imu.name);
  }
  for (const Camera& camera : rig.cameras) {
    require_valid(camera);
    require_new(camera.name);
  }
}

}  // namespace vispline
