#include "vispline/trajectory/fit.h"

#include <algorithm>
#include <cmath>

#include "vispline/trajectory/fit_spline.h"
#include "vispline/trajectory/pose_spline.h"

namespace vispline {
namespace {

constexpr double kOutlier = 10.0;  // usual residuals
constexpr int kPasses = 4;
constexpr double kLeastOutlier = 1e-4;       // m or rad: below it a residual may be what the knots cannot follow
constexpr double kUnknownSigma = 1e-3;       // m and rad, when the data are too short to tell
constexpr double kUnknownJerkDensity = 1e2;  // m/s^3/sqrt(Hz) and rad/s^3/sqrt(Hz)

std::optional<PoseSpectrum> spectrum_of(const Signal<Pose>& poses, const TrajectoryFitOptions& options) {
  try {
    return analyse_spectrum(poses, options.quality);
  } catch (const Error& error) {
    if (!options.spacing_s || error.diagnostic().code != "E-FIT-SHORT") throw;
    return std::nullopt;
  }
}

template <class G>
SplineFitOptions<G> spline_options(const std::optional<PoseSpectrum>& spectrum, double spacing_s) {
  SplineFitOptions<G> options;
  options.spacing = from_seconds(spacing_s);
  options.sigma.setConstant(kUnknownSigma);
  options.jerk_density.setConstant(kUnknownJerkDensity);
  if (spectrum) {
    options.sigma << Vector3d::Constant(spectrum->translation.noise_sigma),
        Vector3d::Constant(spectrum->rotation.noise_sigma);
    options.jerk_density << Vector3d::Constant(spectrum->translation.jerk_density),
        Vector3d::Constant(spectrum->rotation.jerk_density);
  }
  return options;
}

/// A gap is longer than half a period at the motion's bandwidth, or than three knots if that is not known.
std::vector<TimeSpan> gaps_of(const Signal<Pose>& poses, const std::optional<PoseSpectrum>& spectrum,
                              double spacing_s) {
  const double longest =
      spectrum ? 0.5 / std::max(spectrum->translation.bandwidth_hz, spectrum->rotation.bandwidth_hz) : 3.0 * spacing_s;
  std::vector<TimeSpan> gaps;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const TimeSpan span{poses.time[i], poses.time[i + 1]};
    if (span.seconds() > longest) gaps.push_back(span);
  }
  return gaps;
}

template <class Residuals>
FitResidual summary(const Residuals& residuals, Eigen::Index first) {
  FitResidual result;
  double sum = 0.0;
  for (const auto& r : residuals) {
    sum += r.template segment<3>(first).squaredNorm();
    result.max = std::max(result.max, r.template segment<3>(first).cwiseAbs().maxCoeff());
  }
  result.rms = std::sqrt(sum / (3.0 * static_cast<double>(residuals.size())));
  return result;
}

/// Poses, and what is known of their noise and motion. Outliers are taken out one fit at a time: they spoil the
/// spectrum, and with it the fit that would tell them.
struct Measured {
  Signal<Pose> poses;
  std::optional<PoseSpectrum> spectrum;
  double spacing_s;

  Measured(Signal<Pose> p, const TrajectoryFitOptions& options)
      : poses(std::move(p)),
        spectrum(spectrum_of(poses, options)),
        spacing_s(options.spacing_s ? *options.spacing_s
                                    : std::min(spectrum->translation.spacing_s, spectrum->rotation.spacing_s)) {}
};

template <class Fit>
Signal<Pose> without_outliers(const Signal<Pose>& poses, const Fit& fit) {
  Signal<Pose> kept;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (fit.size[i] <= kOutlier || fit.residual[i].cwiseAbs().maxCoeff() <= kLeastOutlier)
      kept.push_back(poses.time[i], poses.value[i]);
  }
  return kept;
}

template <class G, int K>
TrajectoryFit fit_as(const Signal<Pose>& poses, const TrajectoryFitOptions& options) {
  Measured measured(poses, options);
  for (int pass = 1;; ++pass) {
    auto spline = spline_options<G>(measured.spectrum, measured.spacing_s);
    spline.poll = options.poll;
    SplineFit<G, K> fit = SplineFitter<G, K>(measured.poses, spline).run();
    Signal<Pose> kept = without_outliers(measured.poses, fit);
    if (pass < kPasses && kept.size() < measured.poses.size()) {
      measured = Measured(std::move(kept), options);
      continue;
    }
    const std::size_t knots = fit.spline.knots().size();
    return {Trajectory(PoseSpline<G, K>(std::move(fit.spline))),
            measured.spacing_s,
            knots,
            measured.spectrum,
            summary(fit.residual, 0),
            summary(fit.residual, 3),
            gaps_of(measured.poses, measured.spectrum, measured.spacing_s),
            poses.size() - measured.poses.size(),
            fit.iterations,
            fit.converged};
  }
}

template <class G>
TrajectoryFit fit_kind(const Signal<Pose>& poses, const TrajectoryFitOptions& options) {
  switch (options.order) {
    case 4:
      return fit_as<G, 4>(poses, options);
    case 5:
      return fit_as<G, 5>(poses, options);
    default:
      return fit_as<G, 6>(poses, options);
  }
}

}  // namespace

bool TrajectoryFit::in_gap(Time time) const {
  const auto after =
      std::upper_bound(gaps.begin(), gaps.end(), time, [](Time t, const TimeSpan& gap) { return t < gap.begin; });
  return after != gaps.begin() && time > (after - 1)->begin && time < (after - 1)->end;
}

TrajectoryFit fit_trajectory(const Signal<Pose>& poses, const TrajectoryFitOptions& options) {
  require(!poses.empty(), "at least one pose to fit a trajectory to");
  require(!options.spacing_s || *options.spacing_s > 0.0, "a positive knot spacing");
  require(options.order >= 4 && options.order <= 6, "a spline order of 4, 5 or 6");
  return options.kind == SplineKind::kJoint ? fit_kind<SE3>(poses, options) : fit_kind<SplitPose>(poses, options);
}

}  // namespace vispline
