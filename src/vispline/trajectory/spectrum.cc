#include "vispline/trajectory/spectrum.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

constexpr std::size_t kShortest = 64;   // samples of a piece worth a spectrum
constexpr std::size_t kLongest = 2048;  // samples of one window
constexpr double kLongestSpacing_s = 1.0;
constexpr double kLeastSigma = 1e-7;  // m or rad: poses are never better known
constexpr double kPi = std::numbers::pi;

/// Power spectral density, one value per frequency i / (samples * dt), one-sided, unit^2/Hz.
struct Density {
  double resolution_hz = 0.0;
  std::vector<double> value;
  double frequency(std::size_t i) const { return static_cast<double>(i) * resolution_hz; }
};

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_step_s(const Signal<Pose>& poses) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) steps.push_back(to_seconds(poses.time[i + 1] - poses.time[i]));
  return median_of(std::move(steps));
}

/// Poses resampled at a uniform step between gaps; second differences of position and attitude of every piece.
struct SecondDifferences {
  std::vector<Vector3d> translation, rotation;
};

std::vector<SecondDifferences> second_differences(const Signal<Pose>& poses, double step_s) {
  std::vector<SecondDifferences> pieces;
  for (std::size_t first = 0; first < poses.size();) {
    std::size_t last = first;
    while (last + 1 < poses.size() && to_seconds(poses.time[last + 1] - poses.time[last]) < 2.5 * step_s) ++last;
    const auto count =
        static_cast<std::size_t>(to_seconds(poses.time[last] - poses.time[first]) / step_s * (1.0 + 1e-9)) + 1;
    if (count >= kShortest) {
      SecondDifferences piece;
      std::vector<Pose> even;
      std::size_t i = first;
      for (std::size_t k = 0; k < count; ++k) {
        const Time t = poses.time[first] + from_seconds(static_cast<double>(k) * step_s);
        while (i + 1 < last && poses.time[i + 1] <= t) ++i;
        const double u = to_seconds(t - poses.time[i]) / to_seconds(poses.time[i + 1] - poses.time[i]);
        const Pose &A = poses.value[i], &B = poses.value[i + 1];
        even.push_back({A.R * SO3::exp<double>(u * SO3::log<double>(A.R.transpose() * B.R)), A.p + u * (B.p - A.p)});
      }
      for (std::size_t k = 1; k + 1 < even.size(); ++k) {
        piece.translation.push_back(even[k + 1].p - 2.0 * even[k].p + even[k - 1].p);
        piece.rotation.push_back(SO3::log<double>(even[k].R.transpose() * even[k + 1].R) -
                                 SO3::log<double>(even[k - 1].R.transpose() * even[k].R));
      }
      pieces.push_back(std::move(piece));
    }
    first = last + 1;
  }
  return pieces;
}

/// Welch: Hann windows with half overlap, mean over axes and windows; differences undone in the frequency domain.
Density motion_density(const std::vector<SecondDifferences>& pieces, std::vector<Vector3d> SecondDifferences::*motion,
                       double step_s) {
  std::size_t longest = 0;
  for (const auto& piece : pieces) longest = std::max(longest, (piece.*motion).size());
  const std::size_t n = std::min(kLongest, std::bit_floor(longest));
  std::vector<double> window(n);
  double power = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    power += window[i] * window[i];
  }
  Density density{1.0 / (static_cast<double>(n) * step_s), std::vector<double>(n / 2, 0.0)};
  Eigen::FFT<double> fft;
  std::size_t windows = 0;
  for (const auto& piece : pieces) {
    const auto& x = piece.*motion;
    for (std::size_t begin = 0; begin + n <= x.size(); begin += n / 2, ++windows) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::vector<double> segment(n);
        for (std::size_t i = 0; i < n; ++i) segment[i] = window[i] * x[begin + i](axis);
        std::vector<std::complex<double>> transform;
        fft.fwd(transform, segment);
        for (std::size_t i = 1; i < n / 2; ++i) density.value[i] += std::norm(transform[i]);
      }
    }
  }
  for (std::size_t i = 1; i < n / 2; ++i) {
    const double difference = 2.0 * std::sin(kPi * density.frequency(i) * step_s);
    density.value[i] *= 2.0 * step_s / (power * 3.0 * static_cast<double>(windows) * std::pow(difference, 4));
  }
  return density;
}

/// Mean over a third of an octave about the frequency of bin i.
double smoothed(const Density& density, std::size_t i) {
  const std::size_t begin = i - i / 8, end = std::min(i + i / 8, density.value.size() - 1);
  double sum = 0.0;
  for (std::size_t k = begin; k <= end; ++k) sum += density.value[k];
  return sum / static_cast<double>(end - begin + 1);
}

/// The knee: motion falls faster than f^-4 and measurement noise does not, so f^4 S(f) has a minimum where they meet.
/// Of the minima that stand out by a factor of two on both sides, the one at the highest frequency. The lowest
/// frequency if there is nothing but noise, the end of the band if there is no noise.
std::size_t knee(const Density& density) {
  constexpr double kProminence = 2.0;
  const std::size_t end = density.value.size() * 9 / 10;
  double highest_right = 0.0, right_of_least = 0.0, least = std::numeric_limits<double>::infinity();
  std::size_t at = end;
  for (std::size_t i = end; i > 0; --i) {
    const double value = std::pow(density.frequency(i), 4) * smoothed(density, i);
    if (value < least) {
      least = value;
      at = i;
      right_of_least = highest_right;
    } else if (value > kProminence * least && right_of_least > kProminence * least) {
      return at;
    }
    highest_right = std::max(highest_right, value);
  }
  return right_of_least > kProminence * least ? at : end;
}

/// Motion and noise told apart at the knee.
struct Parts {
  Density signal, noise;
  double noise_level;  ///< of the noise below the knee
};

Parts split(const Density& density, std::size_t cut) {
  const double level = 0.5 * smoothed(density, cut);
  Parts parts{density, density, level};
  for (std::size_t i = 0; i < density.value.size(); ++i) {
    parts.noise.value[i] = i <= cut ? level : density.value[i];
    parts.signal.value[i] = i <= cut ? std::max(density.value[i] - level, 0.0) : 0.0;
  }
  return parts;
}

double energy_weight(const Density& density, std::size_t i, int derivative) {
  return std::pow(2.0 * kPi * density.frequency(i), 2 * derivative);
}

/// Mean square error of the derivative after a smoothing spline with the response 1 / (1 + (f / cutoff)^6).
double expected_error(const Parts& parts, int derivative, double cutoff_hz) {
  double error = 0.0;
  for (std::size_t i = 1; i < parts.signal.value.size(); ++i) {
    const double response = 1.0 / (1.0 + std::pow(parts.signal.frequency(i) / cutoff_hz, 6));
    const double missing = 1.0 - response;
    error += energy_weight(parts.signal, i, derivative) *
             (missing * missing * parts.signal.value[i] + response * response * parts.noise.value[i]);
  }
  return error;
}

/// The cutoff with the least expected error, on a grid of 32 to the octave from the first bin to twice the band.
double cutoff_for(const Parts& parts, int derivative) {
  const double lowest = parts.signal.frequency(1), highest = 2.0 * parts.signal.frequency(parts.signal.value.size());
  double best = highest, least = std::numeric_limits<double>::infinity();
  for (double cutoff = lowest; cutoff <= highest; cutoff *= std::exp2(1.0 / 32.0)) {
    const double error = expected_error(parts, derivative, cutoff);
    if (error < least) {
      least = error;
      best = cutoff;
    }
  }
  return best;
}

/// Energy of the derivative that splines of this spacing lose.
double lost_energy(const Density& signal, int derivative, double spacing_s) {
  double lost = 0.0;
  for (std::size_t i = 1; i < signal.value.size(); ++i) {
    const double missing = 1.0 - cubic_spline_response(signal.frequency(i) * spacing_s);
    lost += energy_weight(signal, i, derivative) * signal.value[i] * missing * missing;
  }
  return lost;
}

double total_energy(const Density& signal, int derivative) {
  double total = 0.0;
  for (std::size_t i = 1; i < signal.value.size(); ++i) total += energy_weight(signal, i, derivative) * signal.value[i];
  return total;
}

/// Loses no more than the quality allows, and adds next to nothing to the error that noise leaves anyway.
double largest_spacing_s(const Parts& parts, int derivative, double cutoff_hz, double step_s, double quality) {
  constexpr double kShareOfError = 0.01;
  const auto good = [&](double spacing_s) {
    if (lost_energy(parts.signal, derivative, spacing_s) > (1.0 - quality) * total_energy(parts.signal, derivative)) {
      return false;
    }
    for (const int order : {0, derivative}) {
      if (lost_energy(parts.signal, order, spacing_s) > kShareOfError * expected_error(parts, order, cutoff_hz)) {
        return false;
      }
    }
    return true;
  };
  double low = step_s, high = kLongestSpacing_s;  // the loss grows with the spacing
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    (good(middle) ? low : high) = middle;
  }
  return low;
}

/// Good for the derivative, and no stronger smoothing than is good for the motion itself.
double best_cutoff_hz(const Parts& parts, int derivative) {
  return std::max(cutoff_for(parts, 0), cutoff_for(parts, derivative));
}

MotionSpectrum analyse(const Density& density, int derivative, double step_s, double quality) {
  const std::size_t cut = knee(density);
  const Parts parts = split(density, cut);
  const double two_sided_noise = std::max(0.5 * parts.noise_level, kLeastSigma * kLeastSigma * step_s);
  const double cutoff_hz = best_cutoff_hz(parts, derivative);
  return {.noise_sigma = std::sqrt(two_sided_noise / step_s),
          .bandwidth_hz = density.frequency(cut),
          .jerk_density = std::sqrt(two_sided_noise) * std::pow(2.0 * kPi * cutoff_hz, 3),
          .spacing_s = largest_spacing_s(parts, derivative, cutoff_hz, step_s, quality)};
}

}  // namespace

double cubic_spline_response(double cycles_per_knot) {
  if (cycles_per_knot <= 0.0) return 1.0;
  const double half = kPi * cycles_per_knot;
  const double sinc = std::sin(half) / half;
  return 3.0 * std::pow(sinc, 4) / (2.0 + std::cos(2.0 * half));
}

PoseSpectrum analyse_spectrum(const Signal<Pose>& poses, double quality) {
  require(quality > 0.0 && quality < 1.0, "a quality between 0 and 1");
  const double step_s = poses.size() < kShortest ? 0.0 : median_step_s(poses);
  const auto pieces = step_s > 0.0 ? second_differences(poses, step_s) : std::vector<SecondDifferences>{};
  if (pieces.empty()) {
    throw Error(ExitCode::kUnfit,
                {.code = "E-FIT-SHORT",
                 .message = "no piece of " + std::to_string(kShortest) + " poses without a gap among " +
                            std::to_string(poses.size()) + " poses, too few for a spectrum",
                 .where = "",
                 .effect = "no knot spacing chosen",
                 .next = "give the knot spacing"});
  }
  return {analyse(motion_density(pieces, &SecondDifferences::translation, step_s), 2, step_s, quality),
          analyse(motion_density(pieces, &SecondDifferences::rotation, step_s), 1, step_s, quality)};
}

}  // namespace vispline
