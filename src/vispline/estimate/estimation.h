/// An estimation from start to end, whatever it was made from. docs/math/estimate.md.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/estimate/solve.h"

namespace vispline {

/// One step towards the solution, and the number that says whether it went well.
struct Stage {
  std::string name;     ///< "camera poses of cam0"
  std::string measure;  ///< "rms of reprojection"
  double value = 0.0;
  double limit = 0.0;  ///< a value beyond it is a failure
  std::string unit;
  bool passed = false;
};

/// What an estimation leaves: the last problem, its solution, and how it got there.
struct Estimation {
  Problem problem{};  ///< the last one, with its start
  Solution solution{};
  std::vector<Stage> stages{};
  std::vector<std::pair<std::string, double>> cpu_s{};  ///< processor time by part of the work, in order
  Diagnostics diagnostics{};
};

/// Does a part of the work and notes what it cost.
void timed(Estimation& estimation, const std::string& what, const std::function<void()>& work);

}  // namespace vispline
