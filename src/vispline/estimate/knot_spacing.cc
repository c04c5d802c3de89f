#include "vispline/estimate/knot_spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace vispline {
namespace {

constexpr std::array kSpacings_s{0.2, 0.15, 0.1, 0.08, 0.06, 0.05, 0.04, 0.03, 0.025, 0.02, 0.015, 0.01};
constexpr std::size_t kWindow = 1024;  // samples of one spectrum
constexpr double kTopShare = 0.2;      // of the band, at its upper end, that is taken for noise
constexpr double kSurelyMotion = 3.0;  // noise powers: what a bin of noise alone hardly reaches
constexpr double kFewestSamples = 64;

/// What a least-squares spline of degree L - 1 leaves of a sinusoid, relative to it, on average over its phase.
///   e^2 = S / (f^-2L + S),  S = sum over k != 0 of (f + k)^-2L,  f in cycles a knot      docs/math/estimate.md (7)
double left_over(double frequency_hz, double spacing_s, int L) {
  constexpr int kTerms = 8;
  const double f = frequency_hz * spacing_s;
  if (f >= 1.0) return 1.0;
  if (f <= 0.0) return 0.0;
  double sum = 0.0;
  for (int k = 1; k <= kTerms; ++k) sum += std::pow(k + f, -2 * L) + std::pow(k - f, -2 * L);
  return std::sqrt(sum / (std::pow(f, -2 * L) + sum));
}

/// Mean power of three axes, one-sided: the sum over bins is the variance of one axis.
struct Spectrum {
  std::vector<double> power;
  double step_hz = 0.0;
};

template <class Axis>
Spectrum spectrum(const ImuSignal& imu, const Axis& axis) {
  const std::size_t window = std::min(kWindow, imu.size() / 2 * 2);
  Spectrum out{std::vector<double>(window / 2 + 1, 0.0), 0.0};
  out.step_hz = static_cast<double>(imu.size() - 1) / imu.span().seconds() / static_cast<double>(window);
  Eigen::FFT<double> fft;
  double windows = 0.0;
  for (std::size_t begin = 0; begin + window <= imu.size(); begin += window / 2) {
    for (Eigen::Index a = 0; a < 3; ++a) {
      std::vector<double> x(window);
      double mean = 0.0, energy = 0.0;
      for (std::size_t i = 0; i < window; ++i) mean += axis(imu.value[begin + i])(a) / static_cast<double>(window);
      for (std::size_t i = 0; i < window; ++i) {
        const double hann =
            0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(window));
        x[i] = hann * (axis(imu.value[begin + i])(a) - mean);
        energy += hann * hann;
      }
      std::vector<std::complex<double>> X;
      fft.fwd(X, x);
      for (std::size_t k = 0; k < out.power.size(); ++k) {
        const double sides = k == 0 || 2 * k == window ? 1.0 : 2.0;
        out.power[k] += sides * std::norm(X[k]) / (energy * static_cast<double>(window) * 3.0);
      }
    }
    windows += 1.0;
  }
  for (double& p : out.power) p /= windows;
  return out;
}

/// Power of one bin of the noise: the median of the upper bins.
double noise_power(const Spectrum& s) {
  const auto top = static_cast<std::size_t>((1.0 - kTopShare) * static_cast<double>(s.power.size()));
  std::vector<double> upper(s.power.begin() + static_cast<std::ptrdiff_t>(top), s.power.end());
  std::nth_element(upper.begin(), upper.begin() + static_cast<std::ptrdiff_t>(upper.size() / 2), upper.end());
  return upper[upper.size() / 2];
}

double loss(const Spectrum& s, double noise, double spacing_s, int L) {
  double sum = 0.0;
  for (std::size_t k = 1; k < s.power.size(); ++k) {
    const double left = left_over(static_cast<double>(k) * s.step_hz, spacing_s, L);
    if (s.power[k] > kSurelyMotion * noise) sum += left * left * (s.power[k] - noise);
  }
  return std::sqrt(sum);
}

std::string words(const KnotSpacingChoice& c) {
  char text[320];
  std::snprintf(text, sizeof text,
                "knots every %.3g s leave %.2g rad/s and %.2g m/s^2 of the motion, where one sample has noise of %.2g "
                "rad/s and %.2g m/s^2",
                c.spacing_s, c.gyro_loss, c.accel_loss, c.gyro_noise, c.accel_noise);
  return text;
}

}  // namespace

KnotSpacingChoice choose_knot_spacing(const ImuSignal& imu, int order, double share) {
  KnotSpacingChoice choice;
  if (static_cast<double>(imu.size()) < kFewestSamples) {
    choice.why = "too few samples for a spectrum";
    return choice;
  }
  const Spectrum gyro = spectrum(imu, [](const ImuSample& s) -> const Vector3d& { return s.gyro; });
  const Spectrum accel = spectrum(imu, [](const ImuSample& s) -> const Vector3d& { return s.accel; });
  const double gyro_bin = noise_power(gyro), accel_bin = noise_power(accel);
  choice.gyro_noise = std::sqrt(gyro_bin * static_cast<double>(gyro.power.size()));
  choice.accel_noise = std::sqrt(accel_bin * static_cast<double>(accel.power.size()));
  for (const double spacing_s : kSpacings_s) {
    choice.spacing_s = spacing_s;
    choice.gyro_loss = loss(gyro, gyro_bin, spacing_s, order - 1);
    choice.accel_loss = loss(accel, accel_bin, spacing_s, order - 2);
    if (choice.gyro_loss < share * choice.gyro_noise && choice.accel_loss < share * choice.accel_noise) break;
  }
  choice.why = words(choice);
  return choice;
}

}  // namespace vispline
