#include "vispline/estimate/pose_curve.h"

#include <algorithm>
#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"
#include "vispline/estimate/assemble.h"
#include "vispline/estimate/solve.h"

namespace vispline {
namespace {

constexpr double kOutlier_sigmas = 3.0;
constexpr int kGapSteps = 3;

Duration usual_step(const std::vector<Time>& time) {
  std::vector<Duration> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Straight between poses, held beyond the ends.
Pose interpolate(const Signal<Pose>& poses, Time t) {
  const auto after = std::lower_bound(poses.time.begin(), poses.time.end(), t);
  if (after == poses.time.begin()) return poses.value.front();
  if (after == poses.time.end()) return poses.value.back();
  const auto i = static_cast<std::size_t>(after - poses.time.begin());
  const Pose &A = poses.value[i - 1], &B = poses.value[i];
  const double u = to_seconds(t - poses.time[i - 1]) / to_seconds(poses.time[i] - poses.time[i - 1]);
  return {A.R * SO3::exp<double>(Vector3d(u * SO3::log<double>(Matrix3d(A.R.transpose() * B.R)))),
          A.p + u * (B.p - A.p)};
}

}  // namespace

bool PoseCurve::in_gap(Time time) const {
  const auto after =
      std::upper_bound(gaps.begin(), gaps.end(), time, [](Time t, const TimeSpan& gap) { return t < gap.begin; });
  return after != gaps.begin() && time < (after - 1)->end;
}

PoseCurve fit_pose_curve(const Signal<Pose>& T_w_s, Duration least_spacing, double position_sigma_m,
                         double rotation_sigma_rad) {
  if (T_w_s.size() < 4) {
    throw Error(ExitCode::kUnfit, {"E-TOO-SHORT", std::to_string(T_w_s.size()) + " poses make no motion", "",
                                   "nothing estimated", "record for longer"});
  }
  const Duration step = usual_step(T_w_s.time);
  PoseCurve result;
  for (std::size_t i = 1; i < T_w_s.size(); ++i) {
    if (T_w_s.time[i] - T_w_s.time[i - 1] > kGapSteps * step) result.gaps.push_back({T_w_s.time[i - 1], T_w_s.time[i]});
  }
  Problem problem;
  problem.start.references.resize(1);
  problem.start.curve = make_curve({SplineKind::kSplit, 4, std::max(step, least_spacing)}, T_w_s.span(),
                                   [&](Time t) { return interpolate(T_w_s, t); });
  problem.parameters = parameters_of(problem.start);
  add_poses(problem, 0, T_w_s, T_w_s.span(), position_sigma_m, rotation_sigma_rad, {kOutlier_sigmas});
  add_smoothness(problem);
  SolveOptions options;
  options.covariance = false;
  options.max_iterations = 10;
  options.relative_decrease = 1e-5;
  Solution solution = solve(problem, options);
  for (std::size_t i = 0; i < T_w_s.size(); ++i) {
    const Pose at = solution.state.curve->pose({T_w_s.time[i]});
    result.position_rms_m += (at.p - T_w_s.value[i].p).squaredNorm();
    result.rotation_rms_rad += SO3::log<double>(Matrix3d(at.R.transpose() * T_w_s.value[i].R)).squaredNorm();
  }
  const double count = 3.0 * static_cast<double>(T_w_s.size());
  result.position_rms_m = std::sqrt(result.position_rms_m / count);
  result.rotation_rms_rad = std::sqrt(result.rotation_rms_rad / count);
  result.curve = std::move(solution.state.curve);
  return result;
}

}  // namespace vispline
