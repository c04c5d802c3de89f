#include "demo_loop.h"

#include <cmath>

#include "allan_source.h"
#include "rig_scene.h"
#include "vispline/core/so3.h"
#include "vispline/estimate/assess.h"
#include "vispline/estimate/knot_spacing.h"
#include "vispline/estimate/track_estimation.h"
#include "vispline/io/rig_presets.h"
#include "vispline/simulate/feature_simulation.h"
#include "vispline/simulate/imu_simulation.h"
#include "vispline/trajectory/analytic.h"

namespace vispline::cli {
namespace {

constexpr double kMotion_s = 15.0, kStill_s = 900.0, kCourseRate_hz = 50.0;
constexpr double kScaleSigma = 0.01;  // what is known of the axes of an IMU beforehand

/// What the phone recorded, and the truth behind it.
struct Recorded {
  RigDocument truth{};
  Recording recording{};
  Signal<Pose> T_w_b{};
};

Recorded record(std::uint64_t seed, std::size_t threads) {
  Recorded recorded{.truth = *rig_preset("phone")};
  const Duration duration = from_seconds(kMotion_s), pad = std::chrono::seconds(1);
  const Trajectory dance = *analytic_trajectory("dance", Time{} - pad, duration + 2 * pad);
  Imu& imu = recorded.truth.rig.imus.front();
  const SimulatedImu samples =
      simulate_imu(dance, {.imu = imu, .g_w = recorded.truth.g_w, .seed = seed, .threads = threads},
                   Stamps({Time{}, imu.rate_hz}, duration));
  recorded.recording.imus[imu.name] = samples.measured;
  const auto share = 1.0 / static_cast<double>(samples.bias.size());
  for (std::size_t i = 0; i < samples.bias.size(); ++i) {
    imu.gyroscope.bias += share * samples.bias[i].gyro;
    imu.accelerometer.bias += share * samples.bias[i].accel;
    recorded.T_w_b.push_back(samples.body.time[i], samples.body.value[i].T_w_b());
  }
  Session quiet;
  const SceneSource room =
      load_scene({"room", dance, recorded.truth.rig, {Time{}, Time{} + duration}, std::nullopt, seed}, quiet);
  simulate_features(dance, recorded.truth.rig, room.scene, Time{}, duration,
                    {.clocks = recorded.truth.clocks, .seed = seed, .threads = threads},
                    [&](const SimulatedFrame& frame) {
                      const Camera& camera = recorded.truth.rig.cameras[frame.instant.camera];
                      recorded.recording.features[camera.name].push_back(frame.instant.stamp, frame.features);
                    });
  return recorded;
}

double white_of(const AllanResult& noise, const std::string& sensor, double otherwise) {
  for (const SignalAnalysis& signal : noise.signals) {
    if (signal.sensor == sensor && signal.terms[Term::kWhite].resolved) return signal.terms[Term::kWhite].value;
  }
  return otherwise;
}

/// 5 degrees, 5 cm, 20 ms and 2 % off, no biases, half the line delay: what one knows of a phone.
Rig poor_start(Rig rig, const AllanResult& noise) {
  Imu& imu = rig.imus.front();
  imu.gyroscope = {};
  imu.accelerometer = {};
  imu.noise.gyro.white = white_of(noise, "gyroscope", imu.noise.gyro.white);
  imu.noise.accel.white = white_of(noise, "accelerometer", imu.noise.accel.white);
  for (Camera& camera : rig.cameras) {
    camera.T_c_b.R = camera.T_c_b.R * SO3::exp<double>(Vector3d(0.05, -0.05, 0.05));
    camera.T_c_b.p += Vector3d::Constant(0.05 / std::sqrt(3.0));
    camera.time_offset_s += 0.02;
    camera.shutter.line_delay_s *= 0.5;
    camera.lens.params.head<2>() *= 1.02;
  }
  return rig;
}

TrackEstimationOptions options_of(const Rig& start, double gravity, const ImuSignal& imu, std::size_t threads) {
  const std::string& name = start.imus.front().name;
  TrackEstimationOptions options;
  options.curve.spacing = from_seconds(choose_knot_spacing(imu).spacing_s);
  options.gravity = gravity;
  options.trust_noise = true;
  options.solve.threads = threads;
  options.treatments = {{"cam*.intrinsics", {}},
                        {name + ".gyroscope.scale", {Role::kPrior, kScaleSigma}},
                        {name + ".accelerometer.scale", {Role::kPrior, kScaleSigma}},
                        {name + ".accelerometer.misalignment.upper", {Role::kPrior, kScaleSigma}}};
  return options;
}

}  // namespace

DemoLoop run_loop(std::uint64_t seed, std::size_t threads) {
  const Recorded recorded = record(seed, threads);
  const Imu& imu = recorded.truth.rig.imus.front();
  DemoLoop loop;
  loop.still_s = kStill_s;
  loop.noise = analyze_simulated(imu.noise, imu.rate_hz, kStill_s, seed, {});
  const Rig start = poor_start(recorded.truth.rig, loop.noise);
  const ImuSignal& samples = recorded.recording.imus.at(imu.name);
  const Estimation estimation =
      estimate_with_tracks(start, recorded.recording, options_of(start, recorded.truth.g_w.norm(), samples, threads));
  const Solution& solution = estimation.solution;
  State first = estimation.problem.start, truth = solution.state;
  first.rig = start;
  truth.rig = recorded.truth.rig;
  loop.calibration = assess(estimation.problem, solution, {.threads = threads, .start = &first, .truth = &truth});
  for (const Stage& stage : estimation.stages) {
    loop.calibration.stages.push_back({stage.name, stage.value, stage.limit, stage.unit, stage.passed, stage.measure});
  }
  loop.calibration.knots = {to_seconds(solution.state.curve->spacing()), solution.state.curve->order(), "se3",
                            choose_knot_spacing(samples).why};
  const TimeSpan span = solution.state.curve->span();
  for (Time t = span.begin; t <= span.end; t += from_seconds(1.0 / kCourseRate_hz)) {
    loop.course.T_w_b.push_back(t, solution.state.curve->pose({t}));
  }
  loop.calibration.trajectory =
      compare_trajectories(loop.course.T_w_b, recorded.T_w_b, TrajectoryCompareOptions{AlignmentMode::kYaw, {}});
  const Alignment& alignment = loop.calibration.trajectory->alignment;
  for (std::size_t i = 0; i < recorded.T_w_b.size(); ++i) {
    const Pose& T_r_b = recorded.T_w_b.value[i];
    const Matrix3d R_e_r = alignment.R_r_e.transpose();
    loop.course.truth_T_w_b.push_back(recorded.T_w_b.time[i], {R_e_r * T_r_b.R, R_e_r * (T_r_b.p - alignment.p_r_e)});
  }
  return loop;
}

}  // namespace vispline::cli
