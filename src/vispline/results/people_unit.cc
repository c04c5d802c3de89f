#include "vispline/results/people_unit.h"

#include <numbers>

namespace vispline {

PeopleUnit people_unit(std::string_view unit, std::string_view parameter_name) {
  if (unit == "m") return {"mm", 1e3};
  if (unit == "rad") return {"deg", 180.0 / std::numbers::pi};
  if (unit == "s") return parameter_name.ends_with("line_delay") ? PeopleUnit{"us", 1e6} : PeopleUnit{"ms", 1e3};
  return {std::string(unit), 1.0};
}

}  // namespace vispline
