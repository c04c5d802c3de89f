#include "vispline/allan/edf.h"

#include <gtest/gtest.h>

#include "vispline/allan/chi_square.h"
#include "vispline/allan/nbs14_testing.h"
#include "vispline/allan/noise_type.h"

namespace vispline {
namespace {

TEST(ChiSquare, TabulatedQuantiles) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1), 3.841458821, 1e-8);
  EXPECT_NEAR(chi_square_quantile(0.05, 10), 3.940299136, 1e-8);
  EXPECT_NEAR(chi_square_quantile(0.975, 100), 129.5611972, 1e-6);
  EXPECT_NEAR(chi_square_quantile(0.5, 2), 1.386294361, 1e-8);
  EXPECT_NEAR(chi_square_quantile(0.3, 1.0e5 + 1) / chi_square_quantile(0.3, 1.0e5 - 1), 1.0, 3e-5);
}

TEST(Edf, GreenhallWhiteFrequency) {
  EXPECT_NEAR(edf_of(Deviation::kOadev, 0, 1, 1001) / 782.03, 1.0, 1e-4);
  EXPECT_NEAR(edf_of(Deviation::kOadev, 0, 10, 1001) / 135.07, 1.0, 1e-4);
  EXPECT_NEAR(edf_of(Deviation::kOadev, 0, 100, 1001) / 12.815, 1.0, 1e-4);
}

/// Stable32 1.60, PHASE.DAT (which is the cumulative NBS14 set), overlapping Allan, white frequency noise, 68.3 %.
TEST(Edf, Stable32LimitsOfPhaseDat) {
  struct Row {
    std::int64_t m;
    double low, value, high;
  };
  const Row table[] = {{1, .28515, .29223, .29987},     {2, .19520, .20102, .20738},
                       {4, .13931, .14479, .15098},     {8, .10038, .10570, .11198},
                       {16, .057696, .061915, .067217}, {32, .043654, .048082, .054202},
                       {64, .031755, .036237, .043377}, {128, .023045, .027674, .037027}};
  const Phase phase = testing::nbs14_phase();
  for (const auto& [m, low, value, high] : table) {
    const double sigma = deviation(Deviation::kOadev, squared_sum(Deviation::kOadev, phase, m), m, 1.0);
    const auto factors = deviation_interval(edf_of(Deviation::kOadev, 0, m, 1001), 0.683);
    EXPECT_NEAR(sigma / value, 1.0, 1e-4) << m;
    EXPECT_NEAR(sigma * factors.low / low, 1.0, 1e-3) << m;
    EXPECT_NEAR(sigma * factors.high / high, 1.0, 1e-3) << m;
  }
}

TEST(Edf, AMixtureLiesBetweenItsParts) {
  const NoiseShare half[] = {{0, 0.5}, {-2, 0.5}};
  const double white = edf_of(Deviation::kOadev, 0, 1000, 100001);
  const double walk = edf_of(Deviation::kOadev, -2, 1000, 100001);
  const double mixed = edf_of(Deviation::kOadev, half, 1000, 100001);
  EXPECT_GT(mixed, std::min(white, walk));
  EXPECT_LT(mixed, 1.3 * std::max(white, walk));
  const NoiseShare alone[] = {{0, 1.0}, {-2, 0.0}};
  EXPECT_DOUBLE_EQ(edf_of(Deviation::kOadev, alone, 1000, 100001), white);
}

TEST(Edf, NeverBelowOne) {
  for (const std::int64_t m : {1, 3, 400, 499, 500}) {
    for (const int alpha : {2, 1, 0, -1, -2}) EXPECT_GE(edf_of(Deviation::kOadev, alpha, m, 1001), 1.0);
  }
}

TEST(NoiseType, WhiteFrequencyOfNbs14) {
  const Phase phase = testing::nbs14_phase();
  for (const std::int64_t m : {1, 2, 4, 8}) EXPECT_EQ(noise_alpha(phase, m), 0) << m;
  EXPECT_FALSE(noise_alpha(phase, 64).has_value());
}

}  // namespace
}  // namespace vispline
