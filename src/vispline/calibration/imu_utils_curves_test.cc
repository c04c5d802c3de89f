#include "vispline/calibration/imu_utils_curves.h"

#include <gtest/gtest.h>

#include <numbers>

#include "vispline/core/error.h"

namespace vispline {
namespace {

AllanTriadCurve curve(double scale) {
  AllanTriadCurve value{.tau_s = {0.005, 100.0 / 3.0}, .deviation = {}, .fitted = {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const double axis = static_cast<double>(i + 1);
    value.deviation[i] = {scale * axis, scale * axis / 2};
    value.fitted[i] = {scale * axis * 10, scale * axis * 5};
  }
  return value;
}

TEST(ImuUtilsCurves, SixteenFilesInTheUnitsOfTheScripts) {
  const double one_deg_per_hour = std::numbers::pi / 180.0 / 3600.0;
  const auto files = imu_utils_curves("BMI160", curve(one_deg_per_hour), curve(0.5));
  std::string names, gyr_y, sim_acc_z, t;
  for (const NamedText& file : files) {
    names += file.file_name + " ";
    if (file.file_name == "data_BMI160_gyr_y.txt") gyr_y = file.text;
    if (file.file_name == "data_BMI160_sim_acc_z.txt") sim_acc_z = file.text;
    if (file.file_name == "data_BMI160_acc_t.txt") t = file.text;
  }
  EXPECT_EQ(names,
            "data_BMI160_gyr_t.txt data_BMI160_gyr_x.txt data_BMI160_gyr_y.txt data_BMI160_gyr_z.txt "
            "data_BMI160_acc_t.txt data_BMI160_acc_x.txt data_BMI160_acc_y.txt data_BMI160_acc_z.txt "
            "data_BMI160_sim_gyr_t.txt data_BMI160_sim_gyr_x.txt data_BMI160_sim_gyr_y.txt data_BMI160_sim_gyr_z.txt "
            "data_BMI160_sim_acc_t.txt data_BMI160_sim_acc_x.txt data_BMI160_sim_acc_y.txt data_BMI160_sim_acc_z.txt ");
  EXPECT_EQ(gyr_y, "2\n1\n");
  EXPECT_EQ(sim_acc_z, "15\n7.5\n");
  EXPECT_EQ(t, "0.005\n33.33333333\n");
}

TEST(ImuUtilsCurves, RefusesColumnsOfDifferentLength) {
  AllanTriadCurve broken = curve(1.0);
  broken.fitted[1].pop_back();
  EXPECT_THROW(imu_utils_curves("x", curve(1.0), broken), Error);
}

}  // namespace
}  // namespace vispline
