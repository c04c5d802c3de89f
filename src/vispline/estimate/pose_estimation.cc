#include "vispline/estimate/pose_estimation.h"

#include <algorithm>

#include "vispline/estimate/noise_estimation.h"
#include "vispline/estimate/pose_alignment.h"

namespace vispline {
namespace {

constexpr double kMargin_s = 0.05;  // of the curve beyond the readings: the clock of the poses moves them
constexpr int kNoiseRounds = 4;
constexpr double kFirstPosition_m = 1e-3, kFirstRotation_rad = 2e-3;
constexpr double kWorstRate = 0.5;  // rad/s that the poses may leave of the gyroscope's
constexpr double kLeastCorrelation = 0.5;

struct Sigmas {
  ImuSigma imu{};
  double position_m = kFirstPosition_m, rotation_rad = kFirstRotation_rad;
};

class PoseEstimator {
 public:
  PoseEstimator(const Rig& start, const ImuSignal& imu, const Signal<Pose>& poses, const PoseEstimationOptions& options)
      : imu_(imu), poses_(poses), options_(options) {
    require(!start.imus.empty(), "a rig with an IMU");
    state_.rig.imus = {start.imus.front()};
    state_.references.resize(1);
  }

  Estimation run() {
    timed(result_, "start", [this] { start(); });
    timed(result_, "solve", [this] { solve_stages(); });
    return std::move(result_);
  }

 private:
  void solve_stages() {
    Sigmas sigmas{sigma_of(state_.rig.imus[0])};
    SolveOptions quick = options_.solve;
    quick.covariance = false;
    quick.max_iterations = 6;
    quick.relative_decrease = 1e-3;
    for (int round = 0; round < kNoiseRounds && !options_.trust_noise; ++round) {
      Problem every = problem(sigmas);
      const Solution solution = solve(every, quick);
      state_ = solution.state;
      const auto fits = sensor_fits(every, solution.state, solution.columns, options_.solve.threads);
      rescale_sigma(sigmas.imu, state_.rig.imus[0].name, fits);
      rescale_sigma(sigmas.position_m, "reference0.position", fits);
      rescale_sigma(sigmas.rotation_rad, "reference0.rotation", fits);
    }
    result_.problem = problem(sigmas);
    result_.solution = solve(result_.problem, options_.solve);
  }

  void start() {
    const PoseAlignment alignment = align_poses(poses_, imu_, result_.diagnostics);
    result_.stages.push_back({"clock of the poses", "correlation of |angular rate| with the IMU", alignment.correlation,
                              kLeastCorrelation, "1", alignment.correlation > kLeastCorrelation});
    result_.stages.push_back({"rotation of the poses", "rate that is left", alignment.gyro_residual, kWorstRate,
                              "rad/s", alignment.gyro_residual < kWorstRate});
    PoseReference& reference = state_.references[0];
    reference.time_offset_s = alignment.time_offset_s;
    reference.T_b_k.R = alignment.R_b_s;
    state_.rig.imus[0].gyroscope.bias = alignment.gyro_bias;
    state_.g_w = options_.gravity * alignment.g_w.normalized();
    const Curve& motion = *alignment.motion.curve;
    const Duration offset = from_seconds(alignment.time_offset_s), margin = from_seconds(kMargin_s);
    used_ = {std::max(motion.span().begin + offset, imu_.time.front()),
             std::min(motion.span().end + offset, imu_.time.back())};
    if (used_.seconds() < 1.0) {
      throw Error(ExitCode::kUnfit, {"E-OVERLAP", "poses and IMU share " + std::to_string(used_.seconds()) + " s", "",
                                     "nothing estimated", "check that they are of one recording"});
    }
    state_.curve = make_curve(options_.curve, {used_.begin - margin, used_.end + margin}, [&](Time t) {
      const Time at = std::clamp(t - offset, motion.span().begin, motion.span().end);
      return motion.pose({at}) * reference.T_b_k.inverse();
    });
    if (options_.bias_walk) walk_biases(state_, used_, *options_.bias_walk);
  }

  Problem problem(const Sigmas& sigmas) const {
    const std::string imu = state_.rig.imus[0].name;
    Problem problem;
    problem.start = state_;
    problem.parameters = parameters_of(state_);
    treat(problem.parameters, {{"gravity.direction", {}},
                               {imu + ".gyroscope.bias", {}},
                               {imu + ".accelerometer.bias", {}},
                               {"reference0.T_b_k", {}},
                               {"reference0.time_offset", {}}});
    treat(problem.parameters, options_.treatments);
    add_imu(problem, 0, imu_, used_, sigmas.imu, {});
    const Duration offset = from_seconds(state_.references[0].time_offset_s);
    add_poses(problem, 0, poses_, {used_.begin - offset, used_.end - offset}, sigmas.position_m, sigmas.rotation_rad,
              {options_.huber_sigmas});
    add_bias_walks(problem);
    add_smoothness(problem);
    add_priors(problem);
    return problem;
  }

  const ImuSignal& imu_;
  const Signal<Pose>& poses_;
  const PoseEstimationOptions& options_;
  State state_;
  TimeSpan used_{};
  Estimation result_;
};

}  // namespace

Estimation estimate_with_poses(const Rig& start, const ImuSignal& imu, const Signal<Pose>& poses,
                               const PoseEstimationOptions& options) {
  return PoseEstimator(start, imu, poses, options).run();
}

}  // namespace vispline
