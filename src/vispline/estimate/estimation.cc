#include "vispline/estimate/estimation.h"

#include <ctime>

namespace vispline {

double processor_time_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace vispline
