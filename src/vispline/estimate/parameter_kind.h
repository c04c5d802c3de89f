/// What each number of a parameter is: how it is called, how well it must be known to count as observable, and which
/// motion makes it so. docs/math/uncertainty.md, Limits.
#pragma once

#include <string>
#include <vector>

#include "vispline/estimate/parameter.h"

namespace vispline {

/// Of one direction of a perturbation.
struct ComponentKind {
  std::string name{};  ///< "x", "fu", "tilt 1"; empty if it is the only one
  std::string unit{};
  double limit = 0.0;    ///< of its standard deviation
  std::string remedy{};  ///< "turn about y and z": what makes it observable
};

/// One for each column of the parameter.
std::vector<ComponentKind> component_kinds(const Parameter& parameter, const State& state);

/// One number that is estimated, by its place in the covariance.
struct NamedComponent {
  std::string parameter{};  ///< reported_name()
  int index = 0;            ///< in the parameter
  int size = 1;             ///< of the parameter
  ComponentKind kind{};

  /// "cam0.T_c_i.rotation x".
  std::string label() const { return kind.name.empty() ? parameter : parameter + " " + kind.name; }
};
std::vector<NamedComponent> named_components(const std::vector<Parameter>& parameters, const State& state);

/// Names for people: of the poses of cameras, "T_c_b" is "T_c_i" when the body is the reference IMU.
std::string reported_name(const std::string& name, const State& state);

}  // namespace vispline
