/// Groups of flags that several verbs share, and the values they stand for.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "console.h"
#include "vispline/files/output_file.h"
#include "vispline/io/read.h"
#include "vispline/simulate/imu_simulation.h"
#include "vispline/trajectory/fit.h"

namespace vispline::cli {

void add_session_flags(CLI::App& verb, Session& session);
OutputOptions output_options(const Session& session);

/// How to read the inputs. Each flag holds for all inputs, or is given once for each of them, in order.
struct ReadFlags {
  std::vector<std::string> format, columns, time_unit, rate, gyro_unit, accel_unit, imu_axes, decimal;
  std::vector<std::string> topic, gyro_topic, accel_topic, time;
  bool skip_bad_rows = false, repair = false;

  void add_to(CLI::App& verb);
  /// For input number `index`. "auto" stands for what the file says of itself.
  ReadOptions options(std::size_t index, const Session& session) const;
};

/// A motion: the name of a formula, or a file of poses that a spline is fitted to.
struct TrajectoryFlags {
  std::string source;
  std::optional<double> start_s, duration_s;
  std::string spline = "joint";
  TrajectoryFitOptions fit;

  void add_to(CLI::App& verb);
};

struct TrajectorySource {
  Trajectory trajectory;
  std::optional<TrajectoryFit> fit;  ///< if it came from a file
};

TrajectorySource load_trajectory(const TrajectoryFlags& flags, const ReadFlags& read, Session& session);
/// Knots, spacing, residuals, bandwidth of a fit: for people and for JSON.
std::string fit_text(const TrajectoryFit& fit);
JsonObject fit_json(const TrajectoryFit& fit);

/// The instrument: noise, gravity, place on the body, random streams.
struct ImuFlags {
  std::string noise = "none";
  struct Triad {
    std::optional<double> white, walk, bias_instability, turn_on_bias, quantum, range;
  } gyro, accel;
  double gravity = 9.81, time_offset_s = 0.0;
  std::vector<double> position_m{0.0, 0.0, 0.0};
  std::uint64_t seed = 0;
  std::size_t threads = 0;  ///< 0: all of the machine

  void add_to(CLI::App& verb);
  ImuSimulation simulation(const std::string& name, double rate_hz) const;
};

}  // namespace vispline::cli
