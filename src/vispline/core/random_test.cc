/// Known answers, the range of the uniform numbers, moments, and independence of streams.
#include "vispline/core/random.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace vispline {
namespace {

constexpr std::size_t kDraws = 100000;
const double kSigma = 1.0 / std::sqrt(static_cast<double>(kDraws));  // of a mean of kDraws standard normals

double mean(const std::function<double(std::size_t)>& x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kDraws; ++i) sum += x(i);
  return sum / static_cast<double>(kDraws);
}

TEST(Philox, KnownAnswers) {
  // The test vectors that Random123 ships for philox2x64-10: counter, key, result.
  using Words = r123::Philox2x64::ctr_type;
  const r123::Philox2x64 philox;
  EXPECT_EQ(philox(Words{{0, 0}}, {{0}}), (Words{{0xca00a0459843d731, 0x66c24222c9a845b5}}));
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  EXPECT_EQ(philox(Words{{kAll, kAll}}, {{kAll}}), (Words{{0x65b021d60cd8310f, 0x4d02f3222f86df20}}));
  EXPECT_EQ(philox(Words{{0x243f6a8885a308d3, 0x13198a2e03707344}}, {{0xa4093822299f31d0}}),
            (Words{{0x0a5e742c2997341c, 0xb0f883d38000de5d}}));
}

TEST(RandomStream, NumbersArePinned) {
  // From an independent implementation: counter (index, FNV-1a of the name), key = seed, top 53 bits plus one.
  const auto expect_pair = [](std::array<double, 2> found, double u, double v) {
    EXPECT_EQ(found[0], u);
    EXPECT_EQ(found[1], v);
  };
  expect_pair(RandomStream(42, "imu0/gyro/x").uniform_pair(7), 0x1.6adecfe4dd600p-2, 0x1.ce33903c2df60p-5);
  expect_pair(RandomStream(0, "").uniform_pair(0), 0x1.71281efb9f01bp-1, 0x1.6b42711fca273p-1);
  const RandomStream camera(~std::uint64_t{0}, "camera");
  expect_pair(camera.uniform_pair(std::uint64_t{1} << 40), 0x1.2af422a24da70p-2, 0x1.2a137896e1f20p-1);
}

TEST(RandomStream, NormalsAreBoxMullerOfTheUniforms) {
  const RandomStream stream(9, "box");
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto [u, v] = stream.uniform_pair(i);
    const auto [a, b] = stream.normal_pair(i);
    EXPECT_NEAR(a * a + b * b, -2.0 * std::log(u), 1e-12);
    EXPECT_NEAR(std::remainder(std::atan2(b, a) / (2.0 * M_PI) - v, 1.0), 0.0, 1e-12);
    EXPECT_EQ(stream.normal(2 * i), a);
    EXPECT_EQ(stream.normal(2 * i + 1), b);
  }
}

TEST(RandomStream, UniformsFillTheHalfOpenUnitInterval) {
  const RandomStream stream(1, "uniform");
  std::vector<int> histogram(20);
  for (std::size_t i = 0; i < kDraws; ++i) {
    for (const double u : stream.uniform_pair(i)) {
      ASSERT_GT(u, 0.0);
      ASSERT_LE(u, 1.0);
      ++histogram[static_cast<std::size_t>(std::ceil(u * 20.0)) - 1];
    }
  }
  double chi2 = 0.0;
  const double expected = 2.0 * kDraws / 20.0;
  for (const int count : histogram) chi2 += (count - expected) * (count - expected) / expected;
  EXPECT_LT(chi2, 66.0);  // 19 degrees of freedom: exceeded once in 4e6 seeds
}

TEST(RandomStream, NormalMoments) {
  const RandomStream stream(2, "moments");
  const auto x = [&](std::size_t i) { return stream.normal(i); };
  EXPECT_LT(std::abs(mean(x)), 6.0 * kSigma);
  EXPECT_LT(std::abs(mean([&](std::size_t i) { return std::pow(x(i), 2) - 1.0; })), 6.0 * kSigma * std::sqrt(2.0));
  EXPECT_LT(std::abs(mean([&](std::size_t i) { return std::pow(x(i), 3); })), 6.0 * kSigma * std::sqrt(15.0));
  EXPECT_LT(std::abs(mean([&](std::size_t i) { return std::pow(x(i), 4) - 3.0; })), 6.0 * kSigma * std::sqrt(96.0));
}

TEST(RandomStream, StreamsAreUncorrelated) {
  const RandomStream a(3, "imu0/gyroscope/x"), other_name(3, "imu0/gyroscope/y"), other_seed(4, "imu0/gyroscope/x");
  for (const RandomStream& b : {other_name, other_seed}) {
    EXPECT_LT(std::abs(mean([&](std::size_t i) { return a.normal(i) * b.normal(i); })), 6.0 * kSigma);
  }
  EXPECT_LT(std::abs(mean([&](std::size_t i) { return a.normal(i) * a.normal(i + 1); })), 6.0 * kSigma);
}

TEST(RandomStream, NoNumberComesTwice) {
  std::set<double> seen;
  for (const char* name : {"a", "b", "a/b", ""}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      for (std::uint64_t i = 0; i < 1000; ++i) seen.insert(RandomStream(seed, name).uniform_pair(i)[0]);
    }
  }
  EXPECT_EQ(seen.size(), 16000u);
}

}  // namespace
}  // namespace vispline
