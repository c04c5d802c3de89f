#include "vispline/estimate/track_estimation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vispline/estimate/flow_rotation.h"
#include "vispline/estimate/gyro_rotation.h"
#include "vispline/estimate/noise_estimation.h"
#include "vispline/estimate/pose_measurement.h"
#include "vispline/estimate/track_start.h"
#include "vispline/results/imu_comparison.h"

namespace vispline {
namespace {

constexpr double kMargin_s = 0.05;
constexpr std::size_t kFewestTracks = 10, kFewestSightings = 3;
constexpr double kLeastCorrelation = 0.5;
constexpr double kUsualOffset_s = 0.3;  // of camera clocks against that of the IMU
constexpr double kSameOffset_s = 0.02;
constexpr int kNoiseRounds = 2;
constexpr double kMostBearing_rad = 0.03;
constexpr double kLeastInverse = 1e-3, kMostInverse = 10.0;  // 1/m

class TrackEstimator {
 public:
  TrackEstimator(const Rig& start, const Recording& recording, const TrackEstimationOptions& options)
      : recording_(recording), options_(options) {
    require(!start.imus.empty() && !start.cameras.empty(), "a rig with an IMU and a camera");
    require_valid(start);
    state_.rig = start;
  }

  Estimation run() {
    timed(result_, "start", [this] {
      span();
      find_start();
    });
    timed(result_, "solve", [this] { solve_stages(); });
    return std::move(result_);
  }

 private:
  const ImuSignal& imu(std::size_t i) const { return samples_of(recording_, state_.rig.imus[i]); }

  const FeatureSignal* features(std::size_t c) const {
    const auto found = recording_.features.find(state_.rig.cameras[c].name);
    return found == recording_.features.end() || found->second.empty() ? nullptr : &found->second;
  }

  void span() {
    TimeSpan images{Time::max(), Time::min()};
    for (std::size_t c = 0; c < state_.rig.cameras.size(); ++c) {
      if (!features(c)) continue;
      images.begin = std::min(images.begin, features(c)->time.front());
      images.end = std::max(images.end, features(c)->time.back());
    }
    const TimeSpan samples = imu(0).span();
    used_ = {std::max(images.begin, samples.begin), std::min(images.end, samples.end)};
    if (used_.end - used_.begin < std::chrono::seconds(1)) {
      throw Error(ExitCode::kUnfit, {"E-OVERLAP", "features and IMU share less than one second", "",
                                     "nothing estimated", "check that they are of one recording"});
    }
  }

  /// A motion that nearly repeats has more than one offset that correlates well, and near points hide how a camera
  /// turns: the best offset of all, the best of the usual ones and that of the rig are followed until their costs tell.
  void find_start() {
    for (const Imu& imu : state_.rig.imus) imu_sigma_.push_back(sigma_of(imu));
    for (const Camera& camera : state_.rig.cameras) sigma_px_.push_back(camera.pixel_sigma_px);
    const State begin = state_;
    std::optional<Start> best;
    for (const Clocks from : {Clocks::kBest, Clocks::kBestUsual, Clocks::kGiven}) {
      state_ = begin;
      stages_.clear();
      if (from != Clocks::kGiven && !options_.trust_clocks) {
        clocks(from == Clocks::kBest ? std::nullopt : std::optional(kUsualOffset_s));
      }
      if (best && same_clocks(best->clocks)) continue;
      const std::vector<double> clocks = clocks_of(state_.rig);
      if (!structure()) continue;
      const double cost = first_stages();
      if (!best || cost < best->cost) best = Start{cost, clocks, std::move(state_), tracks_, stages_};
    }
    if (!best) {
      throw Error(ExitCode::kUnfit, {"E-EXCITATION", "the tracks do not determine where the body moves", "",
                                     "nothing estimated", "record with more translation"});
    }
    state_ = std::move(best->state);
    tracks_ = std::move(best->tracks);
    result_.stages = std::move(best->stages);
  }

  enum class Clocks { kBest, kBestUsual, kGiven };

  static std::vector<double> clocks_of(const Rig& rig) {
    std::vector<double> offsets;
    for (const Camera& camera : rig.cameras) offsets.push_back(camera.time_offset_s);
    return offsets;
  }

  bool same_clocks(const std::vector<double>& offsets) const {
    for (std::size_t c = 0; c < offsets.size(); ++c) {
      if (std::abs(offsets[c] - state_.rig.cameras[c].time_offset_s) > kSameOffset_s) return false;
    }
    return true;
  }

  /// Clock and rotation of every camera, and the bias of the gyroscope, from how the cameras turn. `most_s`: the
  /// largest offset to look for.
  void clocks(std::optional<double> most_s) {
    for (std::size_t c = 0; c < state_.rig.cameras.size(); ++c) {
      if (!features(c)) continue;
      Camera& camera = state_.rig.cameras[c];
      const ImuSignal rates = turning_rate(camera, *features(c));
      if (rates.size() < 20) continue;
      const ImuComparison compared = compare_imu(rates, imu(0), {most_s});
      const bool found = compared.aligned && compared.offset_correlation > kLeastCorrelation;
      stages_.push_back({"clock of " + camera.name, "correlation of |angular rate| with the IMU",
                         compared.offset_correlation, kLeastCorrelation, "1", found});
      if (!found) continue;
      camera.time_offset_s = compared.time_offset_s;
      camera.T_c_b.R = compared.R_second_first.transpose();
      for (std::size_t a = 0; a < 3; ++a) {
        state_.rig.imus[0].gyroscope.bias(static_cast<Eigen::Index>(a)) = compared.gyroscope[a].mean;
      }
    }
    for (std::size_t i = 1; i < state_.rig.imus.size(); ++i) {
      const ImuComparison compared = compare_imu(imu(i), imu(0));
      Imu& other = state_.rig.imus[i];
      other.gyroscope.time_offset_s = other.accelerometer.time_offset_s = compared.time_offset_s;
      other.gyroscope.T_b_i.R = other.accelerometer.T_b_i.R = compared.R_second_first;
    }
  }

  /// False if the tracks do not determine where the body moves.
  bool structure() {
    const GyroRotation R_w_b(imu(0), state_.rig.imus[0].gyroscope.bias);
    tracks_ = tracks_of(state_.rig, recording_, used_, kFewestSightings);
    if (tracks_.size() < kFewestTracks) {
      throw Error(ExitCode::kUnfit, {"E-TRACKS", std::to_string(tracks_.size()) + " tracks are too few", "",
                                     "nothing estimated", "give features with ids that last over images"});
    }
    TrackStartInput input;
    input.rig = state_.rig;
    input.R_w_b = R_w_b;
    input.imu_time = imu(0).time;
    input.imu = imu(0).value;
    input.tracks = tracks_;
    input.gravity = options_.gravity;
    input.span = used_;
    const auto start = start_from_tracks(input);
    if (!start) return false;
    stages_.push_back({"linear structure and motion", "rms of bearings", start->bearing_rms, kMostBearing_rad, "rad",
                       start->bearing_rms < kMostBearing_rad});
    const double size = start->g_w.norm();
    stages_.push_back({"gravity", "relative error of its size", std::abs(size / options_.gravity - 1.0), 0.2, "1",
                       std::abs(size / options_.gravity - 1.0) < 0.2});
    set_start(*start, R_w_b);
    return true;
  }

  /// The world is turned so that gravity points down.
  void set_start(const TrackStart& start, const GyroRotation& R_w_b) {
    const Matrix3d level = Eigen::Quaterniond::FromTwoVectors(start.g_w, -Vector3d::UnitZ()).toRotationMatrix();
    const Duration margin = from_seconds(kMargin_s);
    state_.g_w = Vector3d(0.0, 0.0, -options_.gravity);
    state_.curve = make_curve(options_.curve, {used_.begin - margin, used_.end + margin}, [&](Time t) {
      return Pose{level * R_w_b(t), level * start.p_w(t)};
    });
    if (options_.bias_walk) walk_biases(state_, used_, *options_.bias_walk);
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      const Sighting& reference = tracks_[t].sightings.front();
      const Camera& camera = state_.rig.cameras[reference.camera];
      InverseDepthLandmark landmark{*camera.lens.unproject(reference.px), kLeastInverse};
      if (start.point_w[t]) {
        const Pose T_w_b = state_.curve->pose({reference.stamp, camera.delay_s(reference.px)});
        const Vector3d point_c = camera.T_c_b * (T_w_b.inverse() * Vector3d(level * *start.point_w[t]));
        const double depth = point_c.dot(landmark.bearing_c);
        if (depth > 0.0) landmark.inverse_distance = std::clamp(1.0 / point_c.norm(), kLeastInverse, kMostInverse);
      }
      tracks_[t].landmark = t;
      state_.landmarks.push_back(landmark);
    }
  }

  enum class Freed { kMotion, kExtrinsics, kAll };

  Treatments usual(Freed freed) const {
    Treatments list;
    for (std::size_t i = 0; i < state_.rig.imus.size(); ++i) {
      const std::string& name = state_.rig.imus[i].name;
      list.push_back({name + ".gyroscope.bias", {}});
      list.push_back({name + ".accelerometer.bias", {}});
      if (i > 0 && freed != Freed::kMotion) {
        list.push_back({name + ".T_b_i", {}});
        list.push_back({name + ".time_offset", {}});
      }
    }
    for (std::size_t c = 0; c < state_.rig.cameras.size() && freed != Freed::kMotion; ++c) {
      if (!features(c)) continue;
      const Camera& camera = state_.rig.cameras[c];
      list.push_back({camera.name + ".T_c_b", {}});
      list.push_back({camera.name + ".time_offset", {}});
      if (camera.shutter.line_delay_s != 0.0 && freed == Freed::kAll) list.push_back({camera.name + ".line_delay", {}});
    }
    return list;
  }

  Problem problem(const State& start, Freed freed) const {
    Problem problem;
    problem.start = start;
    problem.parameters = parameters_of(start);
    treat(problem.parameters, usual(freed));
    if (freed == Freed::kAll) treat(problem.parameters, options_.treatments);
    for (std::size_t i = 0; i < start.rig.imus.size(); ++i) {
      add_imu(problem, i, imu(i), used_, imu_sigma_[i], {});
    }
    problem.tracks = tracks_;
    problem.track_model = {options_.unknowns, sigma_px_, {options_.huber_sigmas}};
    const Time middle = used_.begin + (used_.end - used_.begin) / 2;
    const auto* gravity = find_parameters(problem.parameters, "gravity.direction").front();
    problem.measurements.push_back(
        gauge_measurement({middle, start.curve->pose({middle}), gravity->treatment.role != Role::kFixed}));
    add_bias_walks(problem);
    add_smoothness(problem);
    add_priors(problem);
    return problem;
  }

  SolveOptions quick() const {
    SolveOptions options = options_.solve;
    options.covariance = false;
    options.max_iterations = 25;
    options.relative_decrease = 1e-3;
    return options;
  }

  /// The motion alone, then with where the cameras are: the cost with the noise of the rig.
  double first_stages() {
    double cost = 0.0;
    for (const Freed freed : {Freed::kMotion, Freed::kExtrinsics}) {
      Problem stage = problem(state_, freed);
      Solution solution = solve(stage, quick());
      cost = solution.cost;
      state_ = std::move(solution.state);
    }
    return cost;
  }

  void solve_stages() {
    State state = state_;
    for (int round = 0; round < kNoiseRounds && !options_.trust_noise; ++round) {
      Problem every = problem(state, Freed::kAll);
      const Solution solution = solve(every, quick());
      state = solution.state;
      rescale(every, solution);
    }
    result_.problem = problem(state, Freed::kAll);
    result_.solution = solve(result_.problem, options_.solve);
  }

  /// Sizes of the noise from the residuals.
  void rescale(const Problem& problem, const Solution& solution) {
    const auto fits = sensor_fits(problem, solution.state, solution.columns, options_.solve.threads);
    for (std::size_t i = 0; i < imu_sigma_.size(); ++i) {
      rescale_sigma(imu_sigma_[i], state_.rig.imus[i].name, fits);
    }
    rescale_sigma(sigma_px_, problem, solution.state);
  }

  const Recording& recording_;
  const TrackEstimationOptions& options_;
  std::vector<ImuSigma> imu_sigma_;
  std::vector<double> sigma_px_;
  /// Where one choice of clocks leads.
  struct Start {
    double cost = 0.0;
    std::vector<double> clocks{};
    State state{};
    std::vector<Track> tracks{};
    std::vector<Stage> stages{};
  };

  State state_;
  TimeSpan used_{};
  std::vector<Track> tracks_;
  std::vector<Stage> stages_;
  Estimation result_;
};

}  // namespace

Estimation estimate_with_tracks(const Rig& start, const Recording& recording, const TrackEstimationOptions& options) {
  return TrackEstimator(start, recording, options).run();
}

}  // namespace vispline
