#include "vispline/calibration/noise_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vispline/calibration/dialect_text.h"
#include "vispline/core/error.h"

namespace vispline {
namespace {

ImuNoiseEntry entry() {
  ImuNoiseEntry value;
  value.gyro_white = 1.5e-4;
  value.accel_white = 2e-3;
  value.gyro_walk.value = 2e-5;
  value.accel_walk.value = 1.0;
  value.rate_hz = 200;
  return value;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string failure_of(const std::string& dialect, const ImuNoiseEntry& noise) {
  try {
    noise_file(dialect, noise);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUsage);
    EXPECT_EQ(error.diagnostic().code, "E-CONFIG");
    return error.what();
  }
  return "";
}

TEST(NoiseFile, KalibrWritesFloatsOnly) {
  EXPECT_EQ(noise_file("kalibr", entry()).text,
            "# Continuous-time noise densities of one axis.\n"
            "accelerometer_noise_density: 0.002  # m/s^2/sqrt(Hz), white\n"
            "accelerometer_random_walk: 1.0  # m/s^3/sqrt(Hz), bias walk\n"
            "gyroscope_noise_density: 0.00015  # rad/s/sqrt(Hz), white\n"
            "gyroscope_random_walk: 2.0e-05  # rad/s^2/sqrt(Hz), bias walk\n"
            "rostopic: /imu0  # sensor_msgs/Imu\n"
            "update_rate: 200.0  # Hz\n");
}

TEST(NoiseFile, VinsFusionHoldsSigmasOfOneSample) {
  ImuNoiseEntry noise = entry();
  noise.rate_hz = 100;  // sqrt: 10
  const std::string text = noise_file("vins-fusion", noise).text;
  EXPECT_TRUE(holds(text, "\nacc_n: 0.02  # m/s^2, one sample at 100 Hz; density 0.002 m/s^2/sqrt(Hz)\n")) << text;
  EXPECT_TRUE(holds(text, "\nacc_w: 10.0  # m/s^3, drift")) << text;
  EXPECT_TRUE(holds(text, "\ng_norm: 9.81 ")) << text;
  EXPECT_TRUE(holds(text, "inflated")) << text;
}

TEST(NoiseFile, DensitiesElsewhere) {
  EXPECT_TRUE(holds(noise_file("orbslam3", entry()).text, "\nIMU.NoiseGyro: 0.00015  # rad/s/sqrt(Hz)\n"));
  EXPECT_TRUE(holds(noise_file("orbslam3", entry()).text, "\nIMU.Frequency: 200.0  # Hz\n"));
  EXPECT_TRUE(holds(noise_file("basalt", entry()).text, "\"gyro_bias_std\": [2.0e-05, 2.0e-05, 2.0e-05]\n  }\n}\n"));
  const std::string openvins = noise_file("openvins", entry()).text;
  EXPECT_TRUE(openvins.starts_with("%YAML:1.0\n")) << openvins;
  EXPECT_TRUE(holds(openvins, "\n  gyroscope_random_walk: 2.0e-05  # rad/s^2/sqrt(Hz), bias walk\n")) << openvins;
  EXPECT_TRUE(holds(openvins, "\n  Tg:  # effect of acceleration")) << openvins;
}

TEST(NoiseFile, ImuUtilsFiguresFollowFromTheDensities) {
  ImuNoiseEntry noise = entry();
  noise.gyro_white = 0.01;
  noise.gyro_walk.value = 5e-5;
  const NamedText file = noise_file("imu_utils", noise);
  EXPECT_EQ(file.file_name, "imu0_imu_param.yaml");
  EXPECT_TRUE(holds(file.text, "      gyr_n: 1.41421356237309")) << file.text;
  EXPECT_TRUE(holds(file.text, "e-01  # rad/s, standard deviation of one sample at 200 Hz\n")) << file.text;
  // sqrt(2 * 0.01 * 5e-5 / sqrt 3), worked out by hand
  EXPECT_TRUE(holds(file.text, "      gyr_w: 7.59835685651592")) << file.text;
  EXPECT_TRUE(file.notes.empty());
}

TEST(NoiseFile, ImuUtilsTablesAreWrittenPerAxis) {
  ImuUtilsTables tables;
  tables.gyro = {.axis = {{{.n = 1, .w = 4}, {.n = 2, .w = 5}, {.n = 3, .w = 6}}}, .average = {.n = 7, .w = 8}};
  tables.accel = {.axis = {{{.n = 11, .w = 14}, {.n = 12}, {.n = 13, .w = 16}}}, .average = {.n = 17, .w = 18}};
  const NamedText file = noise_file("imu_utils", entry(), tables);
  const auto at = [&](const std::string& part) { return file.text.find(part); };
  EXPECT_LT(at("avg-axis:\n      gyr_n: 7.0000000000000000e+00"), at("x-axis:\n      gyr_n: 1.0000000000000000e+00"));
  EXPECT_LT(at("z-axis:\n      gyr_n: 3.0000000000000000e+00"), at("Acc:\n   unit: \" m/s^2\""));
  EXPECT_NE(at("acc_w: 1.6000000000000000e+01"), std::string::npos);
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_EQ(file.notes[0], "Acc y-axis acc_w is left out: the record does not resolve the random walk");
}

TEST(NoiseFile, AnUnresolvedWalkIsItsBoundOrLeftOutInEveryDialect) {
  for (const std::string& dialect : noise_dialects()) {
    ImuNoiseEntry noise = entry();
    noise.gyro_walk = {.upper_bound = 3e-5};
    noise.accel_walk = {};
    const NamedText file = noise_file(dialect, noise);
    std::string notes;
    for (const std::string& note : file.notes) notes += note + "\n";
    EXPECT_TRUE(holds(notes, "upper bound")) << dialect << "\n" << notes;
    EXPECT_TRUE(holds(notes, "left out")) << dialect << "\n" << notes;
    EXPECT_FALSE(holds(file.text, "nan")) << file.text;
    if (dialect == "basalt") {
      EXPECT_TRUE(holds(file.text, "\"gyro_bias_std\": [3.0e-05,")) << file.text;
      EXPECT_FALSE(holds(file.text, "accel_bias_std")) << file.text;
      continue;
    }
    EXPECT_TRUE(holds(file.text, "upper bound")) << file.text;
    EXPECT_TRUE(holds(file.text, dialect == "imu_utils" ? "# acc_w: the record does not" : "no value above 0 is known"))
        << file.text;
  }
}

TEST(NoiseFile, EveryValueLineNamesItsUnit) {
  for (const std::string& dialect : noise_dialects()) {
    if (dialect == "basalt") continue;  // no comments in JSON
    const std::string text = noise_file(dialect, entry()).text;
    for (const char* key : {"noise_density:", "random_walk:", "_n:", "_w:", "IMU.Noise", "Walk:", "update_rate:"}) {
      for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
        const std::string line = text.substr(at, text.find('\n', at) - at);
        EXPECT_TRUE(holds(line, "  # ")) << dialect << ": " << line;
        EXPECT_TRUE(holds(line, "m/s^") || holds(line, "rad/s") || holds(line, "Hz")) << dialect << ": " << line;
      }
    }
  }
}

TEST(NoiseFile, NamesOfStrangersStayData) {
  ImuNoiseEntry noise = entry();
  noise.topic = "x\"\nevil: 1";
  noise.name = "../../etc/passwd";
  EXPECT_TRUE(holds(noise_file("kalibr", noise).text, "rostopic: \"x\\\"\\x0Aevil: 1\"  #"));
  EXPECT_EQ(noise_file("imu_utils", noise).file_name, "______etc_passwd_imu_param.yaml");
}

TEST(NoiseFile, RefusesWhatIsNotAFigure) {
  EXPECT_TRUE(holds(failure_of("kalibrr", entry()), "kalibr, openvins, vins-fusion, orbslam3, basalt, imu_utils"));
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (int field = 0; field < 5; ++field) {
      ImuNoiseEntry noise = entry();
      (field == 0   ? noise.gyro_white
       : field == 1 ? noise.accel_white
       : field == 2 ? noise.rate_hz
       : field == 3 ? *noise.gyro_walk.value
                    : noise.accel_walk.upper_bound.emplace()) = bad;
      EXPECT_TRUE(holds(failure_of("kalibr", noise), "positive number")) << field << " " << bad;
    }
  }
}

TEST(DialectText, FloatsKeepTheirTypeAndValue) {
  using dialect::yaml_float;
  EXPECT_EQ(yaml_float(460), "460.0");
  EXPECT_EQ(yaml_float(0.1), "0.1");
  EXPECT_EQ(yaml_float(1e-5), "1.0e-05");
  EXPECT_EQ(yaml_float(1e300), "1.0e+300");
  EXPECT_EQ(yaml_float(-2.5e-7), "-2.5e-07");
  EXPECT_EQ(yaml_float(0), "0.0");
  EXPECT_EQ(dialect::opencv_float(1.0922514245261136e-04), "1.0922514245261136e-04");
}

TEST(DialectText, OnlyWordsGoWithoutQuotes) {
  using dialect::yaml_string;
  EXPECT_EQ(yaml_string("/imu/data_raw"), "/imu/data_raw");
  EXPECT_EQ(yaml_string("imu"), "imu");
  for (const char* text : {"", "16448", "yes", "No", "null", "a b", "a: b", "- x", "1e5", "x#y", "~"}) {
    EXPECT_EQ(yaml_string(text), "\"" + std::string(text) + "\"");
  }
}

}  // namespace
}  // namespace vispline
