#include "vispline/calibration/read_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace vispline {
namespace {

ImuNoiseEntry entry() {
  ImuNoiseEntry value;
  value.gyro_white = 1.5123456789e-4;
  value.accel_white = 2.1e-3;
  value.gyro_walk.value = 2.7e-5;
  value.accel_walk.value = 3.3e-4;
  value.rate_hz = 196.4;
  value.topic = "/my imu: \"raw\"";
  return value;
}

std::string failure_of(const std::string& text, NoiseReadOptions options = {}) {
  try {
    parse_noise("f", text, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUsage);
    EXPECT_EQ(error.diagnostic().code, "E-CONFIG");
    return error.diagnostic().where + " " + error.diagnostic().message + "; " + error.diagnostic().next;
  }
  return "";
}

const char* const kKalibr =
    "accelerometer_noise_density: 0.002\naccelerometer_random_walk: 3.0e-4\ngyroscope_noise_density: 1e-04\n"
    "gyroscope_random_walk: 2.0e-05\nrostopic: /imu0\nupdate_rate: 200.0\n";

TEST(ReadNoise, WhatIsWrittenReadsBackInEveryDialect) {
  for (const std::string& dialect : noise_dialects()) {
    const ImuNoiseEntry wrote = entry();
    const NoiseReading read = parse_noise("f", noise_file(dialect, wrote).text, {.rate_hz = wrote.rate_hz});
    EXPECT_EQ(read.dialect, dialect);
    const double slack = dialect == "vins-fusion" || dialect == "imu_utils" ? 1e-15 : 0.0;  // sqrt(rate) and back
    EXPECT_NEAR(read.entry.gyro_white / wrote.gyro_white, 1.0, slack) << dialect;
    EXPECT_NEAR(read.entry.accel_white / wrote.accel_white, 1.0, slack) << dialect;
    EXPECT_EQ(read.entry.rate_hz, wrote.rate_hz) << dialect;
    const bool is_bound = dialect == "imu_utils";
    const auto walk = [&](const WalkEntry& figure) { return is_bound ? figure.upper_bound : figure.value; };
    ASSERT_TRUE(walk(read.entry.gyro_walk) && walk(read.entry.accel_walk)) << dialect;
    EXPECT_NEAR(*walk(read.entry.gyro_walk) / *wrote.gyro_walk.value, 1.0, 4 * slack) << dialect;
    EXPECT_NEAR(*walk(read.entry.accel_walk) / *wrote.accel_walk.value, 1.0, 4 * slack) << dialect;
    EXPECT_EQ(read.diagnostics.empty(), !is_bound) << dialect << " " << read.diagnostics.examples().front().message;
  }
  EXPECT_EQ(parse_noise("f", noise_file("kalibr", entry()).text).entry.topic, entry().topic);
  EXPECT_EQ(parse_noise("f", noise_file("openvins", entry()).text).entry.topic, entry().topic);
}

TEST(ReadNoise, AWalkThatIsLeftOutStaysEmptyWithAWarning) {
  for (const std::string& dialect : noise_dialects()) {
    ImuNoiseEntry wrote = entry();
    wrote.accel_walk = {};
    wrote.gyro_walk = {.upper_bound = 1e-5};
    const NoiseReading read = parse_noise("f", noise_file(dialect, wrote).text, {.rate_hz = 196.4});
    EXPECT_FALSE(read.entry.accel_walk.value || read.entry.accel_walk.upper_bound) << dialect;
    EXPECT_TRUE(read.entry.gyro_walk.value || read.entry.gyro_walk.upper_bound) << dialect;
    EXPECT_EQ(read.diagnostics.counts().at("W-CONFIG"), dialect == "imu_utils" ? 2 : 1) << dialect;
  }
}

TEST(ReadNoise, TablesOfImuUtils) {
  ImuUtilsTables tables;
  tables.gyro = {.axis = {{{.n = 1e-3, .w = 4e-5}, {.n = 2e-3, .w = 5e-5}, {.n = 3e-3}}},
                 .average = {.n = 2e-3, .w = 4.5e-5}};
  tables.accel = tables.gyro;
  const NoiseReading read = parse_noise("f", noise_file("imu_utils", entry(), tables).text, {.rate_hz = 100});
  ASSERT_TRUE(read.tables.has_value());
  EXPECT_EQ(read.tables->gyro.axis[1].n, 2e-3);
  EXPECT_EQ(read.tables->gyro.axis[1].w, 5e-5);
  EXPECT_FALSE(read.tables->accel.axis[2].w.has_value());
  EXPECT_EQ(read.entry.gyro_white, 2e-4);
  EXPECT_DOUBLE_EQ(*read.entry.gyro_walk.upper_bound, std::sqrt(3.0) * 4.5e-5 * 4.5e-5 / 4e-4);
}

TEST(ReadNoise, KalibrFormsAndEuroc) {
  const NoiseReading plain = parse_noise("f", kKalibr);
  EXPECT_EQ(plain.dialect, "kalibr");
  EXPECT_EQ(plain.entry.gyro_white, 1e-4);
  EXPECT_EQ(plain.entry.rate_hz, 200.0);
  std::string nested = "imu0:\n  T_i_b: []\n  model: calibrated\n  time_offset: 0.0\n";
  for (const char* line :
       {"accelerometer_noise_density: 0.002", "accelerometer_random_walk: 3.0e-4", "update_rate: 200",
        "gyroscope_noise_density: 1.0e-04", "gyroscope_random_walk: 2.0e-05", "rostopic: /i"}) {
    nested += std::string("  ") + line + "\n";
  }
  EXPECT_EQ(parse_noise("f", nested).dialect, "kalibr");
  EXPECT_EQ(parse_noise("f", nested).entry.topic, "/i");
  EXPECT_TRUE(parse_noise("f", nested).diagnostics.empty());
  EXPECT_EQ(parse_noise("f", "%YAML:1.0\n" + nested).dialect, "openvins");
  const std::string euroc =
      "sensor_type: imu\ncomment: VI-Sensor IMU\nT_BS:\n  cols: 4\nrate_hz: 200\ngyroscope_noise_density: 1.6968e-04\n"
      "gyroscope_random_walk: 1.9393e-05\naccelerometer_noise_density: 2.0000e-3\naccelerometer_random_walk: "
      "3.0000e-3\n";
  EXPECT_EQ(parse_noise("f", euroc).entry.rate_hz, 200.0);
  EXPECT_TRUE(parse_noise("f", euroc).diagnostics.empty());
}

TEST(ReadNoise, MissingMisspeltTextNullNanAndNotPositive) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kKalibr;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(failure_of(with("update_rate: 200.0\n", "")), "f:1:1 key update_rate (Hz) is missing; ");
  EXPECT_EQ(
      failure_of(with("gyroscope_noise_density", "gyroscope_noise_densty")),
      "f:1:1 key gyroscope_noise_density (rad/s/sqrt(Hz)) is missing; line 3 has 'gyroscope_noise_densty': if it is "
      "meant, rename it");
  EXPECT_EQ(
      failure_of(with("gyroscope_random_walk", "gyroscope_random_wlk")),
      "f:1:1 key gyroscope_random_walk (rad/s^2/sqrt(Hz)) is missing; line 4 has 'gyroscope_random_wlk': if it is "
      "meant, rename it");
  EXPECT_EQ(failure_of(with(": 1e-04", ": abc")),
            "f:3:26 gyroscope_noise_density is 'abc', expected a number in rad/s/sqrt(Hz); ");
  EXPECT_EQ(failure_of(with(": 1e-04", ":")),
            "f:3:1 gyroscope_noise_density is nothing, expected a number in rad/s/sqrt(Hz); ");
  for (const char* bad : {": .nan", ": .inf", ": 0.0", ": -1.0", ": 1e400", ": [1.0]", ": \"1.0\"", ": 0,1"}) {
    EXPECT_NE(failure_of(with(": 1e-04", bad)), "") << bad;
  }
  EXPECT_EQ(failure_of(kKalibr + std::string("update_rate: 100.0\n")), "f:7:1 key 'update_rate' comes twice; ");
}

TEST(ReadNoise, ImplausibleAndUnknownAreWarnings) {
  std::string text = kKalibr;
  text.replace(text.find("1e-04"), 5, "12.0");
  const NoiseReading read = parse_noise("f", text + "colour: blue\n");
  ASSERT_EQ(read.diagnostics.counts().at("W-CONFIG"), 2);
  EXPECT_EQ(read.diagnostics.examples()[0].message,
            "gyroscope_noise_density says 12 rad/s/sqrt(Hz): not plausible, 1e-07 to 1 is");
  EXPECT_EQ(read.diagnostics.examples()[1].message, "unknown key 'colour'");
}

TEST(ReadNoise, FiguresOfOneSampleNeedTheRate) {
  const std::string vins = noise_file("vins-fusion", entry()).text;
  EXPECT_EQ(
      failure_of(vins),
      "f:5:8 the figures of this file are those of one sample, and it does not hold the sample rate; give the rate of "
      "the IMU: --rate HZ");
  EXPECT_NE(failure_of(vins, {.rate_hz = -1.0}), "");
  EXPECT_NE(failure_of(noise_file("imu_utils", entry()).text), "");
}

TEST(ReadNoise, BasaltAxesThatDifferAreTheirLargest) {
  const std::string text =
      R"({"value0": {"imu_update_rate": 200.0, "accel_noise_std": [0.01, 0.02, 0.016],
         "gyro_noise_std": [1e-3, 1e-3, 1e-3],
         "accel_bias_std": [0.001, 0.001, 0.001], "gyro_bias_std": [0.0001, 0.0001, 0.0001]}})";
  const NoiseReading read = parse_noise("f", text);
  EXPECT_EQ(read.entry.accel_white, 0.02);
  EXPECT_EQ(read.diagnostics.counts().at("W-CONFIG"), 1);
  EXPECT_NE(failure_of(R"({"value0": {"imu_update_rate": 200.0, "accel_noise_std": [0.01, 0.0, 0.016]}})"), "");
  EXPECT_NE(failure_of(R"({"value0": {"imu_update_rate": 200.0, "accel_noise_std": [0.01, 0.016]}})"), "");
}

TEST(ReadNoise, AFileOfNobody) {
  EXPECT_EQ(failure_of("a: 1\n"),
            "f no noise figures of an IMU in the file; it can be a file of: kalibr, openvins, vins-fusion, orbslam3, "
            "basalt, imu_utils");
}

TEST(ReadNoise, RecordedFiles) {
  const std::string folder = std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/";
  if (!std::filesystem::exists(folder + "kalibr_files")) GTEST_SKIP() << "no recorded data at hand";
  const auto read = [&](const char* name) { return read_noise_file(folder + name, {.rate_hz = 200.0}); };
  const NoiseReading snapdragon = read("kalibr_files/uzhfpv_snapdragon-imu.yaml");
  EXPECT_EQ(snapdragon.dialect, "kalibr");
  EXPECT_EQ(snapdragon.entry.gyro_walk.value, 4e-5);
  EXPECT_EQ(snapdragon.entry.rate_hz, 500.0);
  const NoiseReading tum = read("kalibr_files/open_vins_tum_vi_kalibr_imu_chain.yaml");
  EXPECT_EQ(tum.dialect, "openvins");
  EXPECT_EQ(tum.entry.accel_white, 0.0028);
  EXPECT_TRUE(tum.diagnostics.empty());
  EXPECT_EQ(read("kalibr_files/open_vins_rs_d455_kalibr_imu_chain.yaml").entry.rate_hz, 400.0);
  EXPECT_EQ(read("kalibr_files/open_vins_kaist_vio_kalibr_imu_chain.yaml").entry.accel_walk.value, 0.009);
  const NoiseReading basalt = read("kalibr_files/basalt_tumvi_512_ds_calib.json");
  EXPECT_EQ(basalt.entry.gyro_white, 0.000282);
  EXPECT_TRUE(basalt.diagnostics.empty());
  EXPECT_EQ(read("allan/imu_utils_tables/BMI160_imu_param.yaml").dialect, "imu_utils");
  EXPECT_DOUBLE_EQ(read("allan/imu_utils_tables/BMI160_imu_param.yaml").entry.gyro_white,
                   1.2138209013030823e-03 / std::sqrt(200.0));
  EXPECT_EQ(read("allan/imu_utils_tables/A3_imu_param.yaml").entry.gyro_white, 1.0922514245261136e-04);
}

}  // namespace
}  // namespace vispline
