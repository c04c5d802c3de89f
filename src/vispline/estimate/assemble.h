/// From recordings to measurements: which samples belong together, and with which sigmas. docs/math/estimate.md.
#pragma once

#include <map>
#include <string>

#include "vispline/estimate/imu_measurement.h"
#include "vispline/estimate/problem.h"
#include "vispline/estimate/target_measurement.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// Points of a target by their id; frame t, m.
using TargetPoints = std::map<std::uint64_t, Vector3d>;

/// What an IMU of the rig recorded. Throws Error(kUnfit, E-TOPIC) for next to nothing.
const ImuSignal& samples_of(const Recording& recording, const Imu& imu);

/// Discrete noise of an IMU at its rate: N sqrt(rate). Throws Error E-CONFIG if a density is not positive.
ImuSigma sigma_of(const Imu& imu);

/// The samples within `span`, of one knot spacing each. `signal` must outlive the problem.
void add_imu(Problem& problem, std::size_t imu, const ImuSignal& signal, TimeSpan span, const ImuSigma& sigma,
             const Huber& loss);

/// The frames whose first and last line lie within `span`; points that the target does not have are left out.
void add_target(Problem& problem, std::size_t camera, const FeatureSignal& features, const TargetPoints& target,
                TimeSpan span, double sigma_px, const Huber& loss);

/// All of `signal` within `span`, of one knot spacing each. `signal` must outlive the problem.
void add_poses(Problem& problem, std::size_t reference, const Signal<Pose>& signal, TimeSpan span,
               double position_sigma_m, double rotation_sigma_rad, const Huber& loss);

/// Biases of all IMUs of the rig with nodes every `spacing` over `span`, where the state has none: zero beyond the
/// constant bias.
void walk_biases(State& state, TimeSpan span, Duration spacing);
/// How the biases of the start walk, by the random walks of the rig; nothing if they do not. Throws E-CONFIG for an IMU
/// without random walk.
void add_bias_walks(Problem& problem);

/// Features of all cameras by id, those seen at least `least_sightings` times within `span`.
std::vector<Track> tracks_of(const Rig& rig, const Recording& recording, TimeSpan span, std::size_t least_sightings);

/// What holds the ends of the curve and stretches without readings.
void add_smoothness(Problem& problem);

/// One row for every parameter with a prior, around its start value.
void add_priors(Problem& problem);

/// Treatments by name or pattern (find_parameters), in order; the last one that matches counts.
using Treatments = std::vector<std::pair<std::string, Treatment>>;
void treat(std::vector<Parameter>& parameters, const Treatments& treatments);

}  // namespace vispline
