/// Units in which people think of calibrations: mm, deg, ms. Documents stay in SI.
#pragma once

#include <string>
#include <string_view>

namespace vispline {

struct PeopleUnit {
  std::string name;
  double factor = 1.0;  ///< from SI
};

/// m to mm, rad to deg, s to ms, line delays to us; everything else as it is.
PeopleUnit people_unit(std::string_view unit, std::string_view parameter_name = {});

}  // namespace vispline
