#include "vispline/calibration/imu_utils_explanation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "vispline/calibration/imu_utils_noise.h"

namespace vispline {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

ImuUtilsTables all(ImuUtilsFigure gyro, ImuUtilsFigure accel) {
  return {.gyro = {.axis = {gyro, gyro, gyro}, .average = gyro},
          .accel = {.axis = {accel, accel, accel}, .average = accel}};
}

// Truth N = 0.01, K = 5e-5 at 200 Hz: n = 0.14142, w = 7.598e-4 at 346 s; N = 0.03, K = 1e-5: w = 5.886e-4 at 5196 s.
TEST(ImuUtilsExplanation, TheInverseRecoversNAndK) {
  const auto result = explain_imu_utils(
      all({.n = 0.141421356, .w = 7.59835686e-4}, {.n = 0.424264069, .w = 5.88566e-4}), 200.0, 7200.0);
  const ImuUtilsReading& x = *result.gyro.axes[1].as_sigma;
  EXPECT_NEAR(x.white, 0.01, 1e-9);
  EXPECT_NEAR(*x.walk, 5e-5, 1e-11);
  EXPECT_NEAR(*x.tau_star_s, 346.41, 0.01);
  EXPECT_EQ(x.place, TauStarPlace::kInside);
  const ImuUtilsReading& z = *result.accel.axes[3].as_sigma;
  EXPECT_NEAR(z.white, 0.03, 1e-9);
  EXPECT_NEAR(*z.walk, 1e-5, 1e-10);
  EXPECT_NEAR(*z.tau_star_s, 5196.2, 0.1);
  EXPECT_EQ(z.place, TauStarPlace::kOutside);
  EXPECT_FALSE(result.density_is_likely);
  const std::string text = to_text(result);
  EXPECT_TRUE(holds(text, "tau* is inside the record")) << text;
  EXPECT_TRUE(holds(text, "tau* is outside the record: K means nothing")) << text;
  EXPECT_TRUE(holds(text, "do not paste them as gyroscope_random_walk")) << text;
}

TEST(ImuUtilsExplanation, ThePlaceNeedsTheRecord) {
  const ImuUtilsTables tables = all({.n = 0.141421356, .w = 7.59835686e-4}, {.n = 0.141421356, .w = 7.59835686e-4});
  const auto place = [&](std::optional<double> record_s) {
    return explain_imu_utils(tables, 200.0, record_s).gyro.axes[0].as_sigma->place;
  };
  EXPECT_EQ(place({}), TauStarPlace::kUnknown);
  EXPECT_EQ(place(3465.0), TauStarPlace::kInside);
  EXPECT_EQ(place(3463.0), TauStarPlace::kVague);
  EXPECT_EQ(place(693.0), TauStarPlace::kVague);
  EXPECT_EQ(place(692.0), TauStarPlace::kOutside);
}

TEST(ImuUtilsExplanation, SaturationAndFailedFitsGiveNoWalk) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto result = explain_imu_utils(all({.n = 0.2, .w = 4.84778e-3}, {.n = nan, .w = 1000.0}), 200.0);
  const ImuUtilsAxisMeaning& gyro = result.gyro.axes[0];
  EXPECT_TRUE(gyro.is_saturated);
  EXPECT_TRUE(gyro.as_sigma.has_value());
  EXPECT_FALSE(gyro.as_sigma->walk.has_value());
  EXPECT_TRUE(result.accel.axes[0].is_saturated);
  EXPECT_FALSE(result.accel.axes[0].as_sigma.has_value());
  EXPECT_FALSE(result.density_is_likely);
  EXPECT_TRUE(holds(to_text(result), "w is where the search began (1000)"));
  EXPECT_TRUE(holds(to_text(result), "the fit failed"));
  EXPECT_FALSE(explain_imu_utils(all({.n = 0.2, .w = nan}, {.n = 0.2}), 200.0).gyro.axes[2].as_sigma->walk.has_value());
}

TEST(ImuUtilsExplanation, RefusesARateOrALengthThatIsNone) {
  EXPECT_THROW(explain_imu_utils({}, 0.0), Error);
  EXPECT_THROW(explain_imu_utils({}, 200.0, -1.0), Error);
}

std::string table(const std::string& name) {
  return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/allan/imu_utils_tables/" + name + "_imu_param.yaml";
}

TEST(ImuUtilsExplanation, RecordedFilesOfBothVersions) {
  if (!std::filesystem::exists(table("A3"))) GTEST_SKIP() << "no recorded data at hand";
  const auto bmi160 = explain_imu_utils_file(table("BMI160"), 196.4);
  EXPECT_EQ(bmi160.name, "BMI160");
  EXPECT_FALSE(bmi160.density_is_likely);
  EXPECT_NEAR(bmi160.gyro.axes[0].as_sigma->white, 1.2138209013030823e-03 / std::sqrt(196.4), 1e-15);
  EXPECT_NEAR(*bmi160.gyro.axes[0].as_sigma->tau_star_s, 21.7, 0.1);
  for (const auto& [name, rate] : {std::pair{"A3", 384.0}, {"xsens", 100.0}}) {
    const auto old = explain_imu_utils_file(table(name), rate);
    EXPECT_TRUE(old.density_is_likely) << name;
    EXPECT_TRUE(holds(to_text(old), "white noise density N itself")) << name;
  }
  EXPECT_EQ(explain_imu_utils_file(table("A3"), 384.0).gyro.axes[0].as_density->white, 1.0922514245261136e-04);
  EXPECT_TRUE(bmi160.diagnostics.empty());
}

}  // namespace
}  // namespace vispline
