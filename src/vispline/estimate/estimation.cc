#include "vispline/estimate/estimation.h"

#include <ctime>

namespace vispline {
namespace {

double processor_time_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

void timed(Estimation& estimation, const std::string& what, const std::function<void()>& work) {
  const double begin = processor_time_s();
  work();
  estimation.cpu_s.emplace_back(what, processor_time_s() - begin);
}

}  // namespace vispline
