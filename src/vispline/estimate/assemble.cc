#include "vispline/estimate/assemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "vispline/core/error.h"
#include "vispline/estimate/pose_measurement.h"
#include "vispline/estimate/priors.h"

namespace vispline {
namespace {

/// Calls batch(first, count) for runs of stamps within `span` that last no longer than one knot spacing.
template <class Batch>
void each_batch(const std::vector<Time>& time, TimeSpan span, Duration spacing, const Batch& batch) {
  const auto begin = std::lower_bound(time.begin(), time.end(), span.begin);
  const auto end = std::upper_bound(begin, time.end(), span.end);
  for (auto first = begin; first != end;) {
    const auto last = std::lower_bound(first, end, *first + spacing);
    batch(static_cast<std::size_t>(first - time.begin()), static_cast<std::size_t>(last - first));
    first = last;
  }
}

constexpr std::size_t kFewestSamples = 10;
constexpr std::size_t kSmoothKnots = 12;  // knots whose bends are rows of one measurement

}  // namespace

const ImuSignal& samples_of(const Recording& recording, const Imu& imu) {
  const auto found = recording.imus.find(imu.name);
  if (found != recording.imus.end() && found->second.size() > kFewestSamples) return found->second;
  throw Error(ExitCode::kUnfit, {"E-TOPIC", "the recording has no samples of " + quoted(imu.name), "",
                                 "nothing estimated", "name the recording of every IMU of the rig"});
}

ImuSigma sigma_of(const Imu& imu) {
  const double root = std::sqrt(imu.rate_hz);
  if (imu.noise.gyro.white > 0.0 && imu.noise.accel.white > 0.0) {
    return {imu.noise.gyro.white * root, imu.noise.accel.white * root};
  }
  throw Error(ExitCode::kUsage, {.code = "E-CONFIG",
                                 .message = "the noise densities of " + quoted(imu.name) + " are not positive",
                                 .where = "",
                                 .effect = "nothing estimated",
                                 .next = "give them in the rig file; vispline allan finds them from a still record"});
}

void add_imu(Problem& problem, std::size_t imu, const ImuSignal& signal, TimeSpan span, const ImuSigma& sigma,
             const Huber& loss) {
  each_batch(signal.time, span, problem.start.curve->spacing(), [&](std::size_t first, std::size_t count) {
    problem.measurements.push_back(
        imu_measurement(problem.start, {imu, std::span(signal.time).subspan(first, count),
                                        std::span(signal.value).subspan(first, count), sigma, loss}));
  });
}

void add_target(Problem& problem, std::size_t camera, const FeatureSignal& features, const TargetPoints& target,
                TimeSpan span, double sigma_px, const Huber& loss) {
  for (std::size_t f = 0; f < features.size(); ++f) {
    TargetFrame frame{camera, features.time[f], {}, {}, sigma_px, loss};
    for (const Feature& feature : features.value[f]) {
      const auto point = target.find(feature.id);
      const Time at = frame.stamp + from_seconds(problem.start.rig.cameras[camera].delay_s(feature.px));
      if (point == target.end() || !span.contains(at)) continue;
      frame.px.push_back(feature.px);
      frame.point.push_back(point->second);
    }
    if (!frame.px.empty()) problem.measurements.push_back(target_measurement(problem.start, std::move(frame)));
  }
}

void add_poses(Problem& problem, std::size_t reference, const Signal<Pose>& signal, TimeSpan span,
               double position_sigma_m, double rotation_sigma_rad, const Huber& loss) {
  each_batch(signal.time, span, problem.start.curve->spacing(), [&](std::size_t first, std::size_t count) {
    problem.measurements.push_back(pose_measurement(
        problem.start, {reference, std::span(signal.time).subspan(first, count),
                        std::span(signal.value).subspan(first, count), position_sigma_m, rotation_sigma_rad, loss}));
  });
}

std::vector<Track> tracks_of(const Rig& rig, const Recording& recording, TimeSpan span, std::size_t least_sightings) {
  std::map<std::uint64_t, std::vector<Sighting>> by_id;
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const Camera& camera = rig.cameras[c];
    const auto found = recording.features.find(camera.name);
    if (found == recording.features.end()) continue;
    for (std::size_t f = 0; f < found->second.size(); ++f) {
      for (const Feature& feature : found->second.value[f]) {
        const Time at = found->second.time[f] + from_seconds(camera.delay_s(feature.px));
        if (!span.contains(at) || !camera.lens.unproject(feature.px)) continue;
        by_id[feature.id].push_back({c, found->second.time[f], feature.px});
      }
    }
  }
  std::vector<Track> tracks;
  for (auto& [id, sightings] : by_id) {
    if (sightings.size() < least_sightings) continue;
    std::stable_sort(sightings.begin(), sightings.end(),
                     [](const Sighting& a, const Sighting& b) { return a.stamp < b.stamp; });
    tracks.push_back({tracks.size(), std::move(sightings)});
  }
  return tracks;
}

void walk_biases(State& state, TimeSpan span, Duration spacing) {
  require(spacing > Duration::zero(), "a positive time between the nodes of a bias");
  if (!state.bias_walks.empty()) return;
  const std::int64_t steps = std::max<std::int64_t>(1, (span.end - span.begin + spacing - Duration(1)) / spacing);
  const BiasWalk still{span.begin, spacing,
                       std::vector<Vector6d>(static_cast<std::size_t>(steps + 1), Vector6d::Zero())};
  state.bias_walks.assign(state.rig.imus.size(), still);
}

void add_bias_walks(Problem& problem) {
  for (std::size_t i = 0; i < problem.start.bias_walks.size(); ++i) {
    const Imu& imu = problem.start.rig.imus[i];
    if (!(imu.noise.gyro.walk > 0.0 && imu.noise.accel.walk > 0.0)) {
      throw Error(ExitCode::kUsage,
                  {.code = "E-CONFIG",
                   .message = "the biases of " + quoted(imu.name) + " are to walk, but its rig has no random walk",
                   .where = "",
                   .effect = "nothing estimated",
                   .next = "give random_walk in the rig file; vispline allan finds it from a still record"});
    }
    problem.measurements.push_back(bias_walk_measurement(problem.start, i, imu.noise.gyro.walk, imu.noise.accel.walk));
  }
}

void add_smoothness(Problem& problem) {
  const std::size_t last = problem.start.curve->knots() - 1;
  for (std::size_t first = 0; first + 2 <= last; first += kSmoothKnots - 2) {
    problem.measurements.push_back(smoothness_measurement({}, first, std::min(first + kSmoothKnots - 1, last)));
  }
}

void add_priors(Problem& problem) {
  for (const Parameter& parameter : problem.parameters) {
    if (parameter.treatment.role != Role::kPrior) continue;
    problem.measurements.push_back(prior_measurement(problem.start, parameter));
  }
}

void treat(std::vector<Parameter>& parameters, const Treatments& treatments) {
  for (const auto& [pattern, treatment] : treatments) {
    for (Parameter* parameter : find_parameters(parameters, pattern)) parameter->treatment = treatment;
  }
}

}  // namespace vispline
