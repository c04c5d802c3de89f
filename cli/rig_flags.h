/// The flags of a simulated rig: instruments, scene, front end, outputs.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vispline/io/rig_document.h"
#include "vispline/simulate/feature_simulation.h"
#include "vispline/simulate/render.h"

namespace vispline::cli {

struct RigFlags {
  std::string rig;
  std::string scene = "room";
  std::optional<std::size_t> landmarks;
  FeatureSimulation features;
  bool images = false;
  RenderOptions render;
  std::vector<std::string> with;

  /// The verb's other flags that describe instruments exclude --rig.
  void add_to(CLI::App& verb);
  bool is_given() const { return !rig.empty(); }
  bool wants(const std::string& output) const;
};

/// E-ARGUMENT for a flag of the single IMU, which the rig describes.
void refuse_imu_flags(const CLI::App& verb);

}  // namespace vispline::cli
