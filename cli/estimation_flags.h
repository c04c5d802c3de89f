/// What estimate and calibrate have in common: the rig, what to do with its parameters, the curve, the outputs.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "flags.h"
#include "vispline/estimate/assemble.h"
#include "vispline/estimate/curve.h"
#include "vispline/estimate/solve.h"
#include "vispline/io/rig_file.h"

namespace vispline::cli {

struct EstimationFlags {
  Session session;
  ReadFlags read;
  std::string recording, out, truth, truth_rig;
  std::vector<std::string> rig, imu, free, fix, prior;
  std::string spline = "se3", spacing = "auto", noise = "residuals";
  int order = 4;
  std::optional<double> gravity, bias_walk_s;
  double huber = 3.0;
  int max_iterations = 50, twin = 0, jackknife = 0;
  std::size_t threads = 0;
  bool verbose = false;

  void add_to(CLI::App& verb);

  /// Of --rig; without it one IMU of unknown noise. Diagnostics go to the session.
  RigDocument load_rig();
  /// Samples of every IMU of the rig.
  void read_imus(const Rig& rig, Recording& recording);
  /// The rig file's choices, then --free, --fix, --prior.
  Treatments treatments(const RigDocument& document) const;
  CurveShape curve(double auto_spacing_s) const;
  double gravity_of(const RigDocument& document) const;
  std::optional<Duration> bias_walk() const;
  /// Rows of iterations with -v; an interrupt ends the iterations with the best state so far.
  SolveOptions solve_options();
  bool interrupted() const { return interrupted_; }

 private:
  bool interrupted_ = false;
};

/// "CAM=FILE", or FILE alone for the only camera of the rig. Throws E-ARGUMENT.
std::pair<std::string, std::string> camera_and_file(const std::string& argument, const Rig& rig);

}  // namespace vispline::cli
