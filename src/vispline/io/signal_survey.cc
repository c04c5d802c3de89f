#include "vispline/io/signal_survey.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "vispline/io/read.h"
#include "vispline/io/sensor_folder.h"

namespace vispline {
namespace {

/// Sums about the first value, so that small noise on a large mean keeps its digits.
class AxisMeter {
 public:
  void add(double value) {
    if (count_++ == 0) first_ = min_ = max_ = value;
    const double d = value - first_;
    sum_ += d;
    squares_ += d * d;
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
  }
  AxisSurvey axis() const {
    const double n = std::max(1.0, static_cast<double>(count_)), mean = sum_ / n;
    return {first_ + mean, std::sqrt(std::max(0.0, squares_ / n - mean * mean)), min_, max_};
  }

 private:
  std::int64_t count_ = 0;
  double first_ = 0.0, sum_ = 0.0, squares_ = 0.0, min_ = 0.0, max_ = 0.0;
};

class ImuMeter {
 public:
  void add(std::span<const Time> time, std::span<const ImuSample> samples) {
    for (std::size_t i = 0; i < time.size(); ++i) {
      rhythm_.add(to_ns(time[i]));
      for (std::size_t axis = 0; axis < kImuAxes; ++axis) axis_[axis].add(axis_value(samples[i], axis));
      if (std::isfinite(samples[i].gyro.norm())) gyro_.add(samples[i].gyro.norm());
      if (std::isfinite(samples[i].accel.norm())) accel_.add(samples[i].accel.norm());
    }
  }
  Rhythm rhythm() const { return rhythm_.rhythm(); }
  ImuSurvey survey(const ImuAxes& axes) const {
    ImuSurvey survey{.axes = axes, .axis = {}, .median_gyro = {}, .median_accel = {}};
    for (std::size_t i = 0; i < kImuAxes; ++i) survey.axis[i] = axis_[i].axis();
    if (!gyro_.empty()) survey.median_gyro = quantile(gyro_.values(), 0.5);
    if (!accel_.empty()) survey.median_accel = quantile(accel_.values(), 0.5);
    return survey;
  }

 private:
  RhythmMeter rhythm_;
  std::array<AxisMeter, kImuAxes> axis_;
  EvenSample<double> gyro_, accel_;
};

PoseSurvey survey_of(const Signal<Pose>& poses) {
  PoseSurvey survey;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3d& p_w_b = poses.value[i].p;
    survey.min_w = i == 0 ? p_w_b : Vector3d(survey.min_w.cwiseMin(p_w_b));
    survey.max_w = i == 0 ? p_w_b : Vector3d(survey.max_w.cwiseMax(p_w_b));
    if (i > 0) survey.path_length += (p_w_b - poses.value[i - 1].p).norm();
  }
  return survey;
}

bool holds_nothing_of_the_kind(const SignalSurvey& survey) {
  return survey.error && survey.error->diagnostic().code == "E-COLUMNS";
}

/// A table may hold IMU samples, poses or both; what it does not hold is not an error.
void survey_table(const std::string& path, const std::string& name, const ReadOptions& options,
                  const ReadProgress& progress, std::vector<SignalSurvey>& signals) {
  SignalSurvey imu = survey_imu(path, options, progress);
  const bool no_imu = holds_nothing_of_the_kind(imu);
  if (!no_imu) signals.emplace_back(std::move(imu)).name = name;
  const bool whole = !no_imu && !signals.back().error;
  if (!no_imu && !whole) return;
  SignalSurvey poses = survey_poses(path, options);
  const bool no_poses = holds_nothing_of_the_kind(poses) || (!no_imu && poses.error);
  if (!no_poses) signals.emplace_back(std::move(poses)).name = name;
  if (no_imu && no_poses) throw *imu.error;
}

}  // namespace

SignalSurvey survey_imu(const std::string& path, const ReadOptions& options, const ReadProgress& progress) {
  SignalSurvey survey{.name = options.topic,
                      .format = {},
                      .counts = {},
                      .diagnostics = {},
                      .delay = {},
                      .rhythm = {},
                      .imu = {},
                      .poses = {},
                      .error = {}};
  ImuMeter meter;
  ImuAxes axes;
  const auto sink = [&](std::span<const Time> time, std::span<const ImuSample> samples) { meter.add(time, samples); };
  try {
    ImuStreamResult result = stream_imu(path, options, sink, {.progress = progress});
    axes = result.axes;
    survey.format = std::move(result.format);
    survey.counts = std::move(result.counts);
    survey.diagnostics = std::move(result.diagnostics);
    survey.late = result.late;
    survey.delay = result.delay;
  } catch (const Error& error) {
    survey.error = error;
  }
  survey.rhythm = meter.rhythm();
  if (survey.rhythm.count > 0) survey.imu = meter.survey(axes);
  return survey;
}

SignalSurvey survey_poses(const std::string& path, const ReadOptions& options) {
  SignalSurvey survey{.name = options.topic,
                      .format = {},
                      .counts = {},
                      .diagnostics = {},
                      .delay = {},
                      .rhythm = {},
                      .imu = {},
                      .poses = {},
                      .error = {}};
  try {
    auto result = read_trajectory(path, options);
    survey.format = std::move(result.format);
    survey.counts = std::move(result.counts);
    survey.diagnostics = std::move(result.diagnostics);
    survey.late = result.late;
    RhythmMeter meter;
    for (const Time time : result.value.time) meter.add(to_ns(time));
    survey.rhythm = meter.rhythm();
    survey.poses = survey_of(result.value);
  } catch (const Error& error) {
    survey.error = error;
  }
  return survey;
}

std::vector<SignalSurvey> survey_tables(const std::string& path, const ReadOptions& options,
                                        const ReadProgress& progress) {
  std::vector<SignalSurvey> signals;
  std::error_code error;
  if (!std::filesystem::is_directory(path, error) || !options.topic.empty()) {
    survey_table(path, options.topic, options, progress, signals);
    return signals;
  }
  for (const SensorFile& sensor : sensors_of_interest(path)) {
    survey_table(sensor.path, sensor.name, options, progress, signals);
  }
  return signals;
}

}  // namespace vispline
