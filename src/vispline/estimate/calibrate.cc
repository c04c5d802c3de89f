#include "vispline/estimate/calibrate.h"

#include <algorithm>
#include <cmath>

#include "vispline/core/parallel.h"
#include "vispline/estimate/noise_estimation.h"
#include "vispline/estimate/pnp.h"
#include "vispline/estimate/rolling_poses.h"
#include "vispline/results/imu_comparison.h"

namespace vispline {
namespace {

constexpr double kMostPnp_px = 3.0;       // rms of a camera's poses with the start lens
constexpr double kMostRolling_px = 12.0;  // the same of a rolling shutter, whose place moves while it is read
constexpr std::size_t kFewestFrames = 20;
constexpr double kMargin_s = 0.03;         // of the curve beyond the readings: time offsets move them
constexpr std::size_t kQuickFrames = 150;  // images that are enough for the first stages
constexpr int kNoiseRounds = 3;
constexpr double kNearLambda = 1e-9;     // where only sizes of noise, or the number of images, have changed
constexpr double kImuScaleSigma = 0.02;  // what MEMS sensors are off by, in scale and in rad
constexpr std::size_t kPoseChunk = 16;
constexpr std::size_t kPosePoints = 40;  // that are enough for the start pose of an image

/// Poses of one camera in the frame of the target, one an image.
struct CameraPoses {
  Signal<Pose> T_t_c{};
  double rms_px = 0.0;
};

CameraPoses poses_of(const Camera& camera, const FeatureSignal& features, const TargetPoints& target,
                     std::size_t threads) {
  std::vector<std::optional<PnpResult>> pose(features.size());
  parallel_for((features.size() + kPoseChunk - 1) / kPoseChunk, threads, [&](std::size_t chunk) {
    for (std::size_t f = chunk * kPoseChunk; f < std::min(features.size(), (chunk + 1) * kPoseChunk); ++f) {
      std::vector<Vector2d> px;
      std::vector<Vector3d> point;
      const std::vector<Feature>& seen = features.value[f];
      const std::size_t stride = std::max<std::size_t>(1, seen.size() / kPosePoints);
      for (std::size_t i = 0; i < seen.size(); i += stride) {
        const auto found = target.find(seen[i].id);
        if (found == target.end()) continue;
        px.push_back(seen[i].px);
        point.push_back(found->second);
      }
      if (px.size() >= 4) pose[f] = camera_pose(camera, px, point);
    }
  });
  CameraPoses result;
  double sum = 0.0;
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (!pose[f] || pose[f]->rms_px > 2.0 * kMostPnp_px) continue;
    result.T_t_c.push_back(features.time[f], pose[f]->T_t_c);
    sum += pose[f]->rms_px * pose[f]->rms_px;
  }
  result.rms_px = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(result.T_t_c.size(), 1)));
  return result;
}

class Calibrator {
 public:
  Calibrator(const Rig& start, const Recording& recording, const TargetPoints& target, const CalibrateOptions& options)
      : rig_(start), recording_(recording), target_(target), options_(options) {}

  Estimation run() {
    require(!rig_.imus.empty() && !rig_.cameras.empty(), "a rig with an IMU and a camera");
    require_valid(rig_);
    timed(result_, "start", [this] {
      find_cameras();
      find_other_imus();
      start_curve();
    });
    timed(result_, "solve", [this] { solve_stages(); });
    return std::move(result_);
  }

 private:
  const ImuSignal& reference_imu() const { return samples_of(recording_, rig_.imus.front()); }

  void stage(const std::string& name, const std::string& measure, double value, double limit, const std::string& unit,
             bool passed) {
    result_.stages.push_back({name, measure, value, limit, unit, passed});
  }

  const FeatureSignal* features_of(const Camera& camera) const {
    const auto found = recording_.features.find(camera.name);
    return found == recording_.features.end() ? nullptr : &found->second;
  }

  /// Poses, clock and rotation of every camera.
  void find_cameras() {
    std::size_t most = 0;
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      Camera& camera = rig_.cameras[c];
      const FeatureSignal* features = features_of(camera);
      if (features == nullptr) continue;
      CameraPoses poses = poses_of(camera, *features, target_, options_.solve.threads);
      double limit_px = kMostPnp_px;
      if (camera.shutter.line_delay_s != 0.0) {
        const auto rolling = rolling_poses(camera, *features, target_, poses.T_t_c, reference_imu());
        if (rolling && rolling->T_t_c.size() >= kFewestFrames) {
          poses = {rolling->T_t_c, rolling->rms_px};
          limit_px = kMostRolling_px;
        }
      }
      const bool enough = poses.T_t_c.size() >= kFewestFrames;
      stage("poses of " + camera.name, "rms of reprojection", poses.rms_px, limit_px, "px",
            enough && poses.rms_px < limit_px);
      if (!enough) continue;
      PoseAlignment alignment = align_poses(poses.T_t_c, reference_imu(), result_.diagnostics);
      stage("clock of " + camera.name, "correlation of |angular rate| with the IMU", alignment.correlation, 0.5, "1",
            alignment.correlation > 0.5);
      stage("rotation of " + camera.name, "rate that is left", alignment.gyro_residual, 0.3, "rad/s",
            alignment.gyro_residual < 0.3);
      camera.time_offset_s = alignment.time_offset_s;
      camera.T_c_b.R = alignment.R_b_s.transpose();
      if (poses.T_t_c.size() > most) {
        most = poses.T_t_c.size();
        best_ = c;
        alignment_.emplace(std::move(alignment));
      }
    }
    if (!alignment_) {
      throw Error(ExitCode::kUnfit,
                  {"E-TARGET", "no camera sees the target in " + std::to_string(kFewestFrames) + " images or more", "",
                   "nothing estimated", "check that the corners and the points of the target have the same ids"});
    }
    rig_.imus.front().gyroscope.bias = alignment_->gyro_bias;
  }

  void find_other_imus() {
    for (std::size_t i = 1; i < rig_.imus.size(); ++i) {
      Imu& imu = rig_.imus[i];
      const ImuComparison compared = compare_imu(samples_of(recording_, imu), reference_imu());
      stage("clock of " + imu.name, "correlation of |angular rate| with " + rig_.imus.front().name,
            compared.offset_correlation, 0.5, "1", compared.aligned && compared.offset_correlation > 0.5);
      imu.gyroscope.time_offset_s = imu.accelerometer.time_offset_s = compared.time_offset_s;
      imu.gyroscope.T_b_i.R = imu.accelerometer.T_b_i.R = compared.R_second_first;
    }
  }

  void start_curve() {
    const Camera& camera = rig_.cameras[best_];
    const Curve& motion = *alignment_->motion.curve;
    const Duration offset = from_seconds(alignment_->time_offset_s), margin = from_seconds(kMargin_s);
    const TimeSpan poses{motion.span().begin + offset, motion.span().end + offset};
    const TimeSpan imu = reference_imu().span();
    used_ = {std::max(poses.begin, imu.begin), std::min(poses.end, imu.end)};
    if (used_.seconds() < 1.0) {
      throw Error(ExitCode::kUnfit, {"E-OVERLAP", "images and IMU share " + std::to_string(used_.seconds()) + " s", "",
                                     "nothing estimated", "check that they are of one recording"});
    }
    state_.rig = rig_;
    state_.g_w = options_.gravity * alignment_->g_w.normalized();
    state_.curve = make_curve(options_.curve, {used_.begin - margin, used_.end + margin}, [&](Time t) {
      const Time at = std::clamp(t - offset, motion.span().begin, motion.span().end);
      return motion.pose({at}) * camera.T_c_b;
    });
    if (options_.bias_walk) walk_biases(state_, used_, *options_.bias_walk);
  }

  Treatments usual(bool everything) const {
    Treatments list{{"gravity.direction", {}}};
    for (std::size_t i = 0; i < rig_.imus.size(); ++i) {
      list.push_back({rig_.imus[i].name + ".gyroscope.bias", {}});
      list.push_back({rig_.imus[i].name + ".accelerometer.bias", {}});
      if (i > 0) list.push_back({rig_.imus[i].name + ".T_b_i", {}});
      if (!everything) continue;
      const Treatment about{Role::kPrior, kImuScaleSigma};
      for (const char* part : {".gyroscope.scale", ".gyroscope.misalignment", ".accelerometer.scale",
                               ".accelerometer.misalignment.lower"}) {
        list.push_back({rig_.imus[i].name + part, about});
      }
      if (i > 0) list.push_back({rig_.imus[i].name + ".time_offset", {}});
    }
    for (const Camera& camera : rig_.cameras) {
      if (features_of(camera) == nullptr) continue;
      list.push_back({camera.name + ".T_c_b", {}});
      if (!everything) continue;
      list.push_back({camera.name + ".time_offset", {}});
      if (camera.shutter.line_delay_s != 0.0) list.push_back({camera.name + ".line_delay", {}});
    }
    return list;
  }

  /// `stride`: every so many images only.
  Problem problem(const State& start, bool everything, std::size_t stride) const {
    Problem problem;
    problem.start = start;
    problem.parameters = parameters_of(start);
    treat(problem.parameters, usual(everything));
    if (everything) treat(problem.parameters, options_.treatments);
    for (std::size_t i = 0; i < rig_.imus.size(); ++i) {
      add_imu(problem, i, samples_of(recording_, rig_.imus[i]), used_, imu_sigma_[i], {});
    }
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) {
      const FeatureSignal* features = features_of(rig_.cameras[c]);
      if (features == nullptr) continue;
      add_target(problem, c, thinned(*features, stride), target_, used_, sigma_px_[c], {options_.huber_sigmas});
    }
    add_bias_walks(problem);
    add_smoothness(problem);
    add_priors(problem);
    return problem;
  }

  static FeatureSignal thinned(const FeatureSignal& features, std::size_t stride) {
    FeatureSignal kept;
    for (std::size_t f = 0; f < features.size(); f += stride) kept.push_back(features.time[f], features.value[f]);
    return kept;
  }

  /// First what depends on no clock and no lens, on some of the images; then the sizes of the noise; then everything.
  void solve_stages() {
    for (const Imu& imu : rig_.imus) imu_sigma_.push_back(sigma_of(imu));
    for (const Camera& camera : rig_.cameras) sigma_px_.push_back(camera.pixel_sigma_px);
    const std::size_t stride = recording_.features.empty() ? 1 : std::max<std::size_t>(1, most_frames() / kQuickFrames);
    SolveOptions quick = options_.solve;
    quick.covariance = false;
    quick.max_iterations = 8;
    quick.relative_decrease = 1e-3;
    Problem first = problem(state_, false, stride);
    State state = solve(first, quick).state;
    SolveOptions last = options_.solve;
    if (!options_.trust_noise) last.first_lambda = kNearLambda;
    for (int round = 0; round < kNoiseRounds && !options_.trust_noise; ++round) {
      Problem every = problem(state, true, stride);
      const Solution solution = solve(every, quick);
      state = solution.state;
      rescale(sensor_fits(every, solution.state, solution.columns, options_.solve.threads));
      quick.first_lambda = kNearLambda;
    }
    result_.problem = problem(state, true, 1);
    result_.solution = solve(result_.problem, last);
  }

  std::size_t most_frames() const {
    std::size_t most = 0;
    for (const auto& [name, features] : recording_.features) most = std::max(most, features.size());
    return most;
  }

  void rescale(const std::map<std::string, SensorFit>& fits) {
    for (std::size_t i = 0; i < rig_.imus.size(); ++i) rescale_sigma(imu_sigma_[i], rig_.imus[i].name, fits);
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c) rescale_sigma(sigma_px_[c], rig_.cameras[c].name, fits);
  }

  Rig rig_;
  const Recording& recording_;
  const TargetPoints& target_;
  const CalibrateOptions& options_;
  Estimation result_;
  std::size_t best_ = 0;
  std::optional<PoseAlignment> alignment_;
  State state_;
  TimeSpan used_{};
  std::vector<ImuSigma> imu_sigma_;
  std::vector<double> sigma_px_;
};

}  // namespace

Estimation calibrate(const Rig& start, const Recording& recording, const TargetPoints& target,
                     const CalibrateOptions& options) {
  return Calibrator(start, recording, target, options).run();
}

}  // namespace vispline
