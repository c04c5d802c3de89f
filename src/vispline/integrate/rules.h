/// Strapdown integration rules: how one step of dead reckoning uses the samples around it. docs/math/integrate.md.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/integrate/nav_state.h"
#include "vispline/integrate/sample_window.h"

namespace vispline {

/// The state at the end of the window's step. g_w is gravitational acceleration and points down, m/s^2.
using StepFunction = NavState (*)(const NavState& start, const SampleWindow& window, const Vector3d& g_w);

struct IntegrationRule {
  std::string_view name;
  std::string_view summary;  ///< one line for a table or a help text
  int order;                 ///< the error falls as (sample period)^order on smooth motion
  StepFunction step;
};

/// All rules, the crudest first.
std::span<const IntegrationRule> integration_rules();

/// Their names, in the same order.
std::vector<std::string> rule_names();

/// Throws Error(kUsage, "E-METHOD") that lists the names if there is no such rule.
const IntegrationRule& integration_rule(std::string_view name);

}  // namespace vispline
