#include "vispline/estimate/pose_alignment.h"

#include <algorithm>
#include <cmath>

#include "vispline/estimate/accelerometer_axes.h"
#include "vispline/results/imu_comparison.h"

namespace vispline {
namespace {

constexpr double kStandardGravity = 9.80665;  // m/s^2
constexpr double kLeastCorrelation = 0.5;     // of |angular rate|
constexpr double kMostResidual = 0.6;         // of the rate's own standard deviation: above it axes disagree
constexpr double kSameMotion = 0.85;          // correlation of the sizes of rates of one motion, at least
constexpr std::size_t kForces = 2000;         // readings that are enough to tell the axes
constexpr double kLeastRate = 0.05;           // rad/s, standard deviation: below it there is no motion to align
constexpr double kPositionSigma_m = 2e-3, kRotationSigma_rad = 2e-3;  // of poses, roughly
constexpr Duration kLeastSpacing = std::chrono::milliseconds(20);
constexpr double kDegrees = 57.29577951308232;

[[noreturn]] void unfit(const char* code, const std::string& message, const std::string& next) {
  throw Error(ExitCode::kUnfit, {code, message, "", "nothing estimated", next});
}

std::string text(double x) {
  std::string s = std::to_string(x);
  return s.substr(0, s.find('.') + 4);
}

/// What an exact IMU at the poses would read, at the stamps of the real one as far as they may be apart.
ImuSignal virtual_imu(const PoseCurve& motion, double rate_hz) {
  ImuSignal imu;
  const TimeSpan span = motion.curve->span();
  const SampleClock clock{span.begin, rate_hz};
  for (std::int64_t i = 0; clock(i) <= span.end; ++i) {
    if (motion.in_gap(clock(i))) continue;
    const BodyState state = motion.curve->state({clock(i)});
    imu.push_back(clock(i), {state.omega_b, state.R_w_b.transpose() * state.a_w});
  }
  return imu;
}

double spread(const ImuSignal& imu) {
  Vector3d mean = Vector3d::Zero(), square = Vector3d::Zero();
  for (const ImuSample& s : imu.value) {
    mean += s.gyro / static_cast<double>(imu.size());
    square += s.gyro.cwiseAbs2() / static_cast<double>(imu.size());
  }
  return std::sqrt(std::max(0.0, (square - mean.cwiseAbs2()).sum()));
}

double median_force(const ImuSignal& imu) {
  std::vector<double> norms;
  for (const ImuSample& s : imu.value) norms.push_back(s.accel.norm());
  std::nth_element(norms.begin(), norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2), norms.end());
  return norms[norms.size() / 2];
}

void check_units(const ImuSignal& measured, const ImuSignal& expected) {
  const double ratio = spread(measured) / spread(expected);
  if (ratio > kDegrees / 3.0 && ratio < 3.0 * kDegrees) {
    unfit("E-UNITS", "the angular rate is " + text(ratio) + " times that of the poses: it looks like deg/s",
          "pass --gyro-unit deg/s");
  }
  const double force = median_force(measured);
  if (force > 0.8 && force < 1.2) {
    unfit("E-UNITS", "the usual specific force is " + text(force) + ": it looks like g", "pass --accel-unit g");
  }
  if (force < 0.5 * kStandardGravity) {
    unfit("E-UNITS", "the usual specific force is " + text(force) + " m/s^2: there is no gravity in it",
          "record the raw accelerometer: gravity must not be removed");
  }
  if (force > 2.0 * kStandardGravity) {
    unfit("E-UNITS", "the usual specific force is " + text(force) + " m/s^2", "check the unit of the accelerometer");
  }
}

void check_excitation(const ImuSignal& measured, const ImuSignal& expected, const ImuComparison& compared) {
  if (std::min(spread(measured), spread(expected)) < kLeastRate) {
    unfit("E-EXCITATION",
          "the angular rate varies by " + text(std::min(spread(measured), spread(expected))) + " rad/s only",
          "record a motion that turns about all three axes");
  }
  if (!compared.aligned || compared.offset_correlation < kLeastCorrelation) {
    unfit("E-CLOCK",
          "the angular rates of poses and IMU agree at no offset in time: the best correlation is " +
              text(compared.offset_correlation),
          "check that both stamps come from one clock and that the recordings belong together");
  }
  for (const auto& [code, count] : compared.diagnostics.counts()) {
    if (code == "W-EXCITATION") {
      unfit("E-EXCITATION", "the body turns about one axis only", "record a motion that turns about all three axes");
    }
  }
}

double residual(const ImuComparison& compared) {
  double sum = 0.0;
  for (const AxisComparison& axis : compared.gyroscope) sum += axis.std * axis.std;
  return std::sqrt(sum);
}

/// Rates that agree in size but not in direction belong to other axes; those that hardly agree in size to another
/// motion.
void check_directions(const ImuSignal& imu, const PoseAlignment& alignment) {
  if (alignment.gyro_residual <= kMostResidual * spread(imu)) return;
  const std::string left = text(alignment.gyro_residual) + " rad/s of " + text(spread(imu)) + " rad/s remain";
  if (alignment.correlation < kSameMotion || alignment.gyro_residual > spread(imu)) {
    unfit("E-CLOCK",
          "the angular rates of poses and IMU agree at no offset in time: " + left +
              " at the best one, where their sizes correlate by " + text(alignment.correlation),
          "check that both stamps come from one clock and that the recordings belong together");
  }
  unfit("E-AXES", "the angular rates of poses and gyroscope agree in size but not in direction: " + left,
        "check the order and the signs of the axes of the gyroscope");
}

/// Finds gravity on the way.
void check_accelerometer(const ImuSignal& imu, PoseAlignment& alignment) {
  const std::size_t stride = std::max<std::size_t>(1, imu.size() / kForces);
  std::vector<FeltForce> felt;
  for (std::size_t i = 0; i < imu.size(); i += stride) {
    const Time t = imu.time[i] - from_seconds(alignment.time_offset_s);
    if (!alignment.motion.curve->span().contains(t) || alignment.motion.in_gap(t)) continue;
    const BodyState state = alignment.motion.curve->state({t});
    felt.push_back({state.R_w_b * alignment.R_b_s.transpose(), state.a_w, imu.value[i].accel});
  }
  const AxesChoice choice = accelerometer_axes(felt);
  alignment.g_w = choice.g_w;
  if (!choice.axes.isIdentity()) {
    unfit("E-AXES",
          "the accelerometer does not turn with the gyroscope: its readings x, y, z look like those along " +
              choice.words,
          "check the order and the signs of the axes of the accelerometer");
  }
  if (std::abs(alignment.g_w.norm() - kStandardGravity) > 0.3 * kStandardGravity) {
    unfit("E-AXES",
          "gravity comes out as " + text(alignment.g_w.norm()) +
              " m/s^2: the accelerometer does not turn with the gyroscope",
          "check the order and the signs of the axes of the accelerometer");
  }
}

}  // namespace

PoseAlignment align_poses(const Signal<Pose>& T_w_s, const ImuSignal& imu, Diagnostics& diagnostics) {
  PoseAlignment alignment;
  alignment.motion = fit_pose_curve(T_w_s, kLeastSpacing, kPositionSigma_m, kRotationSigma_rad);
  const double rate_hz = static_cast<double>(imu.size() - 1) / imu.span().seconds();
  const ImuSignal expected = virtual_imu(alignment.motion, rate_hz);
  check_units(imu, expected);
  const ImuComparison compared = compare_imu(expected, imu);
  check_excitation(imu, expected, compared);
  diagnostics.merge(compared.diagnostics);
  alignment.time_offset_s = compared.time_offset_s;
  alignment.correlation = compared.offset_correlation;
  alignment.confidence = compared.offset_confidence;
  alignment.R_b_s = compared.R_second_first;
  for (int axis = 0; axis < 3; ++axis)
    alignment.gyro_bias(axis) = compared.gyroscope[static_cast<std::size_t>(axis)].mean;
  alignment.gyro_residual = residual(compared);
  check_directions(imu, alignment);
  check_accelerometer(imu, alignment);
  return alignment;
}

}  // namespace vispline
