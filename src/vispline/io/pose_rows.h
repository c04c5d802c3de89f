/// Poses as rows, before they are made rotations: from a table or from messages.
#pragma once

#include <string>
#include <vector>

#include "vispline/io/stamp_screen.h"

namespace vispline {

/// values: position x y z, quaternion x y z w. Stamps strictly increase.
struct PoseRows {
  std::vector<SensorRow> rows;
  std::string format;
};

}  // namespace vispline
