#include "vispline/results/imu_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "vispline/core/so3.h"
#include "vispline/results/coarse_offset.h"
#include "vispline/results/gaps.h"
#include "vispline/results/imu_refinement.h"
#include "vispline/results/imu_spline.h"
#include "vispline/results/table.h"

namespace vispline {
namespace {

constexpr std::size_t kMinSamples = 10;
constexpr double kGapPeriods = 3.0, kGapFloor = 0.05;  // s
constexpr double kMinCorrelation = 0.2;                // of |angular rate|
constexpr double kNoiseMargin = 2.0;                   // times what independent noise would give
constexpr double kMinConfidence = 0.1;
constexpr double kMinVariance = 1e-18;  // of an axis, as a share of its mean square
constexpr double kMarginSteps = 2.0;    // grid steps by which the coarse offset may be off

void require_samples(const ImuSignal& imu, const char* which) {
  if (imu.size() >= kMinSamples) return;
  throw Error(ExitCode::kUnfit, {.code = "E-TOO-SHORT",
                                 .message = std::string(which) + " has " + std::to_string(imu.size()) +
                                            " samples, at least " + std::to_string(kMinSamples) + " are needed",
                                 .where = "",
                                 .effect = "nothing compared",
                                 .next = "pass a longer recording"});
}

[[noreturn]] void fail_overlap(const ImuSignal& first, const ImuSignal& second) {
  throw_no_overlap(
      "the first", first.span(), "the second", second.span(),
      "if the clocks differ, shift one of them, or allow a larger offset: vispline evaluate --max-offset SECONDS");
}

bool spans_overlap(const ImuSignal& first, const ImuSignal& second) {
  return first.time.front() <= second.time.back() && second.time.front() <= first.time.back();
}

void warn(ImuComparison& comparison, std::string code, std::string message, std::string effect, std::string next) {
  comparison.diagnostics.add({.code = std::move(code),
                              .message = std::move(message),
                              .where = "",
                              .effect = std::move(effect),
                              .next = std::move(next)});
}

/// Seconds from the first sample of `first` to that of `second`: offset = lag + this.
double start_difference_s(const ImuSignal& first, const ImuSignal& second) {
  return to_seconds(second.time.front() - first.time.front());
}

CoarseOffset coarse_offset(const ImuSpline& spline, const ImuSignal& first, const ImuSignal& second, double step_s,
                           const ImuCompareOptions& options) {
  if (!options.max_offset_s && !spans_overlap(first, second)) fail_overlap(first, second);
  const double limit_s = options.max_offset_s.value_or(std::numeric_limits<double>::infinity());
  const double start_s = start_difference_s(first, second);
  const ImuSpline other(second, gap_limit_s(second.time, kGapPeriods, kGapFloor));
  const std::optional<CoarseOffset> found =
      find_coarse_offset(spline, other, step_s, {-limit_s - start_s, limit_s - start_s});
  if (!found) fail_overlap(first, second);
  return *found;
}

/// Keeps offset 0 and the identity, and says why.
void give_up(ImuComparison& comparison, const CoarseOffset& coarse) {
  warn(comparison, "W-EXCITATION",
       "too little common rotation to find a time offset: the best correlation of the angular rates is " +
           number_text(coarse.correlation, 3),
       "time offset 0 and no rotation between the frames were used",
       "compare recordings of the same motion, with rotation about at least two axes");
}

void warn_about_offset(ImuComparison& comparison, const CoarseOffset& coarse, const ImuRefinement& fit) {
  if (comparison.offset_confidence < kMinConfidence) {
    warn(comparison, "W-AMBIGUOUS",
         "the motion fits a second time offset almost as well: correlation " + number_text(coarse.correlation, 4) +
             ", and " + number_text(coarse.second_correlation, 4) + " at " +
             number_text(coarse.second_lag_s - coarse.lag_s, 4) + " s from it",
         "the offset with the better fit and the longer overlap was used",
         "limit the offset (vispline evaluate --max-offset SECONDS), or record a motion that does not repeat");
  }
  if (!fit.converged) {
    warn(comparison, "W-CONVERGENCE", "the refinement of the time offset did not converge",
         "the offset is that of the correlation peak, good to a fraction of a sample",
         "check that both files hold the same motion");
  }
  if (!fit.rotation_observable) {
    warn(comparison, "W-EXCITATION", "the motion turns about one axis only",
         "the rotation about that axis is unknown; the smallest rotation that fits was used",
         "record rotation about at least two axes");
  }
}

void find_alignment(ImuComparison& comparison, const ImuSpline& spline, const ImuSignal& first, const ImuSignal& second,
                    const ImuCompareOptions& options) {
  const double step_s = std::max(median_period_s(first.time), median_period_s(second.time));
  const CoarseOffset coarse = coarse_offset(spline, first, second, step_s, options);
  comparison.offset_correlation = coarse.correlation;
  if (coarse.correlation < std::max(kMinCorrelation, kNoiseMargin * coarse.noise_correlation)) {
    give_up(comparison, coarse);
    return;
  }
  comparison.aligned = true;
  comparison.offset_confidence = std::clamp(1.0 - coarse.second_correlation / coarse.correlation, 0.0, 1.0);
  const ImuRefinement fit = refine_alignment(spline, second, coarse.lag_s, kMarginSteps * coarse.step_s);
  comparison.time_offset_s = fit.lag_s + start_difference_s(first, second);
  comparison.R_second_first = fit.R_second_first;
  comparison.rotation_vector = SO3::log<double>(fit.R_second_first);
  warn_about_offset(comparison, coarse, fit);
}

/// Pairs of readings (aligned first, second) at the same instant: rows gyro x y z, accel x y z.
struct Pairs {
  std::vector<Vector6d> first, second;
};

/// Stamps are whole nanoseconds: a signal is not outside its own copy because the offset is 1e-20 s and not 0.
double snapped(double seconds, double duration_s) {
  constexpr double kTick_s = 1e-9;
  const bool inside = seconds > -kTick_s && seconds < duration_s + kTick_s;
  return inside ? std::clamp(seconds, 0.0, duration_s) : seconds;
}

Pairs pair_samples(ImuComparison& comparison, const ImuSpline& spline, const ImuSignal& second, double lag_s) {
  Pairs pairs;
  for (std::size_t k = 0; k < second.size(); ++k) {
    const double seconds = snapped(to_seconds(second.time[k] - second.time.front()) - lag_s, spline.duration_s());
    const std::optional<std::size_t> interval = spline.interval(seconds);
    if (!interval) {
      ++(seconds < 0.0 || seconds > spline.duration_s() ? comparison.outside : comparison.in_gaps);
      continue;
    }
    const Vector6d value = spline.value(*interval, seconds);
    const ImuSample aligned{comparison.R_second_first * value.head<3>(), comparison.R_second_first * value.tail<3>()};
    comparison.first_at_second.push_back(second.time[k], aligned);
    pairs.first.emplace_back() << aligned.gyro, aligned.accel;
    pairs.second.emplace_back() << second.value[k].gyro, second.value[k].accel;
  }
  comparison.compared = static_cast<std::int64_t>(pairs.first.size());
  return pairs;
}

/// docs/math/evaluate.md (25)-(27)
AxisComparison compare_axis(const Pairs& pairs, Eigen::Index axis) {
  const auto n = static_cast<double>(pairs.first.size());
  double mean_first = 0.0, mean_second = 0.0;
  for (std::size_t k = 0; k < pairs.first.size(); ++k) {
    mean_first += pairs.first[k](axis) / n;
    mean_second += pairs.second[k](axis) / n;
  }
  double xx = 0.0, yy = 0.0, xy = 0.0, dd = 0.0;
  for (std::size_t k = 0; k < pairs.first.size(); ++k) {
    const double x = pairs.first[k](axis) - mean_first, y = pairs.second[k](axis) - mean_second;
    xx += x * x / n;
    yy += y * y / n;
    xy += x * y / n;
    dd += (y - x) * (y - x) / n;
  }
  AxisComparison result;
  result.mean = mean_second - mean_first;
  result.std = std::sqrt(dd);
  result.rms = std::hypot(result.mean, result.std);
  const bool varies =
      xx > kMinVariance * (xx + mean_first * mean_first) && yy > kMinVariance * (yy + mean_second * mean_second);
  if (varies) result.correlation = std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0);
  return result;
}

void warn_unpaired(ImuComparison& comparison, std::size_t samples) {
  if (comparison.in_gaps + comparison.outside == 0) return;
  warn(comparison, "W-UNPAIRED",
       std::to_string(comparison.in_gaps + comparison.outside) + " of " + std::to_string(samples) +
           " samples of the second file have no counterpart: " + std::to_string(comparison.outside) +
           " beyond the ends of the first, " + std::to_string(comparison.in_gaps) + " in its gaps",
       "those samples were not compared", "");
}

}  // namespace

ImuComparison compare_imu(const ImuSignal& first, const ImuSignal& second, const ImuCompareOptions& options) {
  require(options.max_offset_s.value_or(0.0) >= 0.0, "a largest time offset of at least 0 s");
  require_samples(first, "the first file");
  require_samples(second, "the second file");
  const ImuSpline spline(first, gap_limit_s(first.time, kGapPeriods, kGapFloor));
  ImuComparison comparison;
  find_alignment(comparison, spline, first, second, options);
  const double lag_s = comparison.time_offset_s - start_difference_s(first, second);
  const Pairs pairs = pair_samples(comparison, spline, second, lag_s);
  if (comparison.compared < 2) fail_overlap(first, second);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    comparison.gyroscope[axis] = compare_axis(pairs, static_cast<Eigen::Index>(axis));
    comparison.accelerometer[axis] = compare_axis(pairs, static_cast<Eigen::Index>(axis) + 3);
  }
  warn_unpaired(comparison, second.size());
  return comparison;
}

}  // namespace vispline
