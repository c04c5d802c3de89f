#include "vispline/trajectory/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "vispline/core/error.h"
#include "vispline/core/random.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

constexpr double kPi = std::numbers::pi;

/// Sines up to `highest_hz` with the spectrum of a hand-held camera, falling as f^-6, and white noise.
Signal<Pose> moving(double rate_hz, double duration_s, double highest_hz, double sigma_m, double sigma_rad,
                    std::uint64_t seed) {
  const RandomStream random(seed, "motion");
  Signal<Pose> poses;
  const auto count = static_cast<std::uint64_t>(rate_hz * duration_s);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / rate_hz;
    Vector3d p = Vector3d::Zero(), r = Vector3d::Zero();
    for (int k = 1; k <= 20; ++k) {
      const double f = highest_hz * k / 20.0;
      for (int axis = 0; axis < 3; ++axis) {
        const auto [u, v] = random.uniform_pair(static_cast<std::uint64_t>(100 * axis + k));
        p(axis) += 0.02 / (k * k * k) * std::sin(2.0 * kPi * (f * t + u));
        r(axis) += 0.2 / (k * k * k) * std::sin(2.0 * kPi * (f * t + v));
      }
    }
    const auto noise = [&](std::uint64_t j) { return random.normal(1'000'000 + 6 * i + j); };
    p += sigma_m * Vector3d(noise(0), noise(1), noise(2));
    r += sigma_rad * Vector3d(noise(3), noise(4), noise(5));
    poses.push_back(Time(from_seconds(t)), {SO3::exp<double>(r), p});
  }
  return poses;
}

TEST(Spectrum, FindsTheNoiseAndTheBandwidthOfTheMotion) {
  const auto spectrum = analyse_spectrum(moving(120.0, 60.0, 4.0, 1e-4, 1e-3, 3), 0.99);
  // Half of the density at the knee is taken for noise: between 1/2 and 1 of the true standard deviation squared.
  EXPECT_GT(spectrum.translation.noise_sigma, 0.6e-4);
  EXPECT_LT(spectrum.translation.noise_sigma, 1.6e-4);
  EXPECT_GT(spectrum.rotation.noise_sigma, 0.6e-3);
  EXPECT_LT(spectrum.rotation.noise_sigma, 1.6e-3);
  EXPECT_GT(spectrum.translation.bandwidth_hz, 1.0);
  EXPECT_LT(spectrum.translation.bandwidth_hz, 4.5);
}

TEST(Spectrum, KnowsPureNoiseAndPureMotion) {
  const auto noise = analyse_spectrum(moving(120.0, 60.0, 0.0, 1e-4, 1e-3, 3), 0.99);
  EXPECT_LT(noise.translation.bandwidth_hz, 0.5);
  EXPECT_LT(noise.rotation.bandwidth_hz, 0.5);
  const auto motion = analyse_spectrum(moving(120.0, 60.0, 4.0, 0.0, 0.0, 3), 0.99);
  EXPECT_LE(motion.translation.noise_sigma, 1.001e-7);
  EXPECT_GT(motion.translation.bandwidth_hz, 4.0);
}

TEST(Spectrum, ScalesWithTime) {
  // The same poses at ten times the rate move ten times faster.
  const auto slow = moving(100.0, 60.0, 4.0, 1e-4, 1e-3, 3);
  Signal<Pose> fast = slow;
  for (Time& t : fast.time) t = Time(t.time_since_epoch() / 10);
  const auto a = analyse_spectrum(slow, 0.99), b = analyse_spectrum(fast, 0.99);
  EXPECT_NEAR(b.translation.bandwidth_hz, 10.0 * a.translation.bandwidth_hz, 1e-6);
  EXPECT_NEAR(b.rotation.spacing_s, 0.1 * a.rotation.spacing_s, 1e-6);
}

TEST(Spectrum, BetterQualityMeansCloserKnots) {
  const auto poses = moving(120.0, 60.0, 4.0, 1e-3, 1e-2, 5);
  const auto spacing_s = [&](double quality) { return analyse_spectrum(poses, quality).translation.spacing_s; };
  EXPECT_GE(spacing_s(0.9), spacing_s(0.999));
  EXPECT_GT(spacing_s(0.999), spacing_s(0.999999));
  EXPECT_GT(spacing_s(0.999999), spacing_s(0.99999999));
}

TEST(Spectrum, LessNoiseMeansCloserKnots) {
  double before = 1.0;
  for (const double sigma_m : {1e-3, 1e-4, 1e-5}) {
    const double spacing_s = analyse_spectrum(moving(120.0, 60.0, 4.0, sigma_m, 1e-3, 5), 0.99).translation.spacing_s;
    EXPECT_LT(spacing_s, before);
    before = spacing_s;
  }
}

TEST(Spectrum, SurvivesGaps) {
  const auto whole = moving(120.0, 60.0, 4.0, 1e-4, 1e-3, 3);
  Signal<Pose> gappy;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (i % 900 > 30) gappy.push_back(whole.time[i], whole.value[i]);
  }
  const auto a = analyse_spectrum(whole, 0.999), b = analyse_spectrum(gappy, 0.999);
  EXPECT_NEAR(b.translation.noise_sigma, a.translation.noise_sigma, 0.5 * a.translation.noise_sigma);
  EXPECT_NEAR(b.rotation.bandwidth_hz, a.rotation.bandwidth_hz, 0.5 * a.rotation.bandwidth_hz);
}

TEST(Spectrum, RefusesTooFewPoses) {
  EXPECT_THROW(analyse_spectrum(moving(120.0, 0.4, 4.0, 0.0, 0.0, 1), 0.99), Error);
  EXPECT_THROW(analyse_spectrum({}, 0.99), Error);
  EXPECT_THROW(analyse_spectrum(moving(120.0, 2.0, 4.0, 0.0, 0.0, 1), 1.0), Error);
}

TEST(CubicSplineResponse, IsOneAtZeroAndFallsAsTheFourthPower) {
  EXPECT_EQ(cubic_spline_response(0.0), 1.0);
  // 3 sinc^4(x) / (2 + cos 2 pi x) = 1 - (pi x)^4 / 45 + ...: the basis reproduces cubics.
  const double x = 0.02;
  EXPECT_NEAR(1.0 - cubic_spline_response(x), std::pow(kPi * x, 4) / 45.0, 5e-3 * std::pow(kPi * x, 4) / 45.0);
  EXPECT_NEAR(cubic_spline_response(0.5), 3.0 * std::pow(2.0 / kPi, 4), 1e-12);
}

}  // namespace
}  // namespace vispline
