/// All unknowns of an estimation as plain values, and where each has its columns in the linear system.
/// docs/math/estimate.md, Unknowns.
#pragma once

#include <memory>
#include <vector>

#include "vispline/estimate/curve.h"
#include "vispline/sensors/landmark.h"
#include "vispline/sensors/rig.h"

namespace vispline {

/// Bias of one IMU that walks: straight lines between nodes, added to the constant bias of the calibration.
struct BiasWalk {
  Time begin{};
  Duration spacing = from_seconds(1.0);
  std::vector<Vector6d> node{};  ///< (gyroscope rad/s, accelerometer m/s^2); empty: the bias is constant

  struct Place {
    std::size_t first;
    double u;  ///< the bias is (1 - u) node[first] + u node[first + 1]
  };
  /// Before the first and after the last node the bias stays.
  Place locate(const Instant& at) const;
  Vector6d at(const Instant& at) const;
};

/// An outside instrument that measures where the body is, in a world m of its own: motion capture, GNSS.
struct PoseReference {
  Pose T_m_w{};                ///< world of the estimate to the world of the instrument
  Pose T_b_k{};                ///< what the instrument tracks, on the body: rotation and lever arm
  double time_offset_s = 0.0;  ///< t_body = t_reference + time_offset
};

struct State {
  std::unique_ptr<Curve> curve{};  ///< T_w_b
  Rig rig{};
  Vector3d g_w{0.0, 0.0, -9.81};
  std::vector<BiasWalk> bias_walks{};  ///< by IMU of the rig
  std::vector<InverseDepthLandmark> landmarks{};
  std::vector<PoseReference> references{};

  State() = default;
  State(const State& other) { *this = other; }
  State(State&&) = default;
  State& operator=(const State& other);
  State& operator=(State&&) = default;
};

/// First system column of every unknown; the landmarks have none, they are eliminated. Parameters of rig and world come
/// last (parameter.h), so that their covariance is the tail of the inverse.
struct Layout {
  std::vector<int> knot{};               ///< six columns each
  std::vector<std::vector<int>> bias{};  ///< [imu][node], six columns each
  int first_parameter = 0;
  int columns = 0;

  int parameters() const { return columns - first_parameter; }
};

}  // namespace vispline
