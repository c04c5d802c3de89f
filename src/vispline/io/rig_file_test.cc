/// Rigs: our own file reads back to the same values, and those of other tools mean what their pages say.
#include "vispline/io/rig_file.h"

#include "vispline/calibration/rig_files.h"
#include "vispline/io/euroc_folder.h"
#include "vispline/io/io_testing.h"
#include "vispline/io/rig_convert.h"
#include "vispline/io/rig_presets.h"

namespace vispline {
namespace {

std::string data(const std::string& name) { return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/" + name; }

#define SKIP_IF_ABSENT() \
  if (!std::filesystem::exists(data("README.md"))) GTEST_SKIP() << "no recorded data at hand"

Pose random_pose(Numbers& numbers) { return {SO3::exp<double>(numbers.vector()), numbers.vector()}; }

template <class Params>
void set_triad(Params& params, Numbers& numbers) {
  params.T_b_i = random_pose(numbers);
  params.scale = 1e-2 * numbers.vector();
  params.misalignment << 1e-3 * numbers.vector(), 1e-3 * numbers.vector();
  params.bias = numbers.vector();
  params.time_offset_s = 1e-3 * numbers.normal();
}

Imu random_imu(const std::string& name, Numbers& numbers) {
  Imu imu{.name = name, .rate_hz = 187.5};
  set_triad(imu.gyroscope, numbers);
  set_triad(imu.accelerometer, numbers);
  for (int i = 0; i < 3; ++i) imu.gyroscope.g_sensitivity.col(i) = 1e-4 * numbers.vector();
  imu.noise.gyro = {1.7e-4, 1.9e-5, 3e-5, 0.01, 1e-4, 8.7};
  imu.noise.accel = {2e-3, 3e-3, 4e-4, 0.1, 6e-4, 78.5};
  return imu;
}

Camera random_camera(const std::string& name, LensModel model, Numbers& numbers) {
  static constexpr int kBefore[] = {0, 0, 0, 0, 1, 1, 2, 2}, kAfter[] = {0, 4, 4, 1, 0, 4, 0, 0};
  const auto row = static_cast<std::size_t>(model);
  Camera camera{.name = name, .rate_hz = 29.97, .resolution_px = {752, 480}, .T_c_b = random_pose(numbers)};
  camera.lens.model = model;
  camera.lens.params.resize(kBefore[row] + 4 + kAfter[row]);
  for (double& value : camera.lens.params) value = 0.5 + 0.01 * numbers.normal();
  camera.lens.params.segment<4>(kBefore[row]) += Eigen::Vector4d(458.0, 457.0, 367.0, 248.0);
  camera.time_offset_s = 1e-3 * numbers.normal();
  camera.shutter = {3e-5, static_cast<ReadoutDirection>(row % 4), 0.004};
  camera.pixel_sigma_px = 0.37;
  return camera;
}

RigDocument random_document(std::uint64_t seed) {
  Numbers numbers(seed);
  RigDocument document;
  for (const char* name : {"imu0", "left imu"}) document.rig.imus.push_back(random_imu(name, numbers));
  for (int i = 0; i < 8; ++i) {
    document.rig.cameras.push_back(random_camera("cam" + std::to_string(i), static_cast<LensModel>(i), numbers));
  }
  document.g_w = Vector3d(0.1, -0.2, -9.80665);
  document.estimate = {{"gravity", {ParameterChoice::Kind::kFixed}},
                       {"cam0.intrinsics", {ParameterChoice::Kind::kFree}},
                       {"imu0.T_b_i", {ParameterChoice::Kind::kPrior, 0.01}}};
  document.clocks = {{"left imu", {.phase_s = 0.0021, .drift = -3e-5}}, {"cam3", {.phase_s = 0.01}}};
  return document;
}

void expect_same(const Pose& a, const Pose& b) {
  EXPECT_EQ(a.R, b.R);
  EXPECT_EQ(a.p, b.p);
}

template <class Params>
void expect_same_triad(const Params& a, const Params& b) {
  expect_same(a.T_b_i, b.T_b_i);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.misalignment, b.misalignment);
  EXPECT_EQ(a.bias, b.bias);
  EXPECT_EQ(a.time_offset_s, b.time_offset_s);
}

void expect_same_noise(const NoiseModel& a, const NoiseModel& b) {
  EXPECT_EQ(a.white, b.white);
  EXPECT_EQ(a.walk, b.walk);
  EXPECT_EQ(a.bias_instability, b.bias_instability);
  EXPECT_EQ(a.turn_on_bias, b.turn_on_bias);
  EXPECT_EQ(a.quantum, b.quantum);
  EXPECT_EQ(a.range, b.range);
}

void expect_same_camera(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.rate_hz, b.rate_hz);
  EXPECT_EQ(a.resolution_px, b.resolution_px);
  EXPECT_EQ(a.lens.model, b.lens.model);
  EXPECT_EQ(a.lens.params, b.lens.params);
  expect_same(a.T_c_b, b.T_c_b);
  EXPECT_EQ(a.time_offset_s, b.time_offset_s);
  EXPECT_EQ(a.shutter.line_delay_s, b.shutter.line_delay_s);
  EXPECT_EQ(a.shutter.direction, b.shutter.direction);
  EXPECT_EQ(a.shutter.exposure_s, b.shutter.exposure_s);
  EXPECT_EQ(a.pixel_sigma_px, b.pixel_sigma_px);
}

TEST(RigFile, OurOwnReadsBackToTheSame) {
  const ScratchFolder folder;
  const RigDocument document = random_document(41);
  write_rig(folder.path("rig.yaml"), document);
  const ReadRig read = read_rig({folder.path("rig.yaml")});
  EXPECT_TRUE(read.diagnostics.empty());
  EXPECT_EQ(read.formats, std::vector<std::string>{"vispline"});
  EXPECT_EQ(read.g_w, document.g_w);
  EXPECT_EQ(read.estimate, document.estimate);
  ASSERT_EQ(read.clocks.size(), 2U);
  EXPECT_EQ(read.clocks.at("left imu").drift, -3e-5);
  EXPECT_EQ(read.clocks.at("cam3").phase_s, 0.01);
  ASSERT_EQ(read.rig.imus.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Imu &a = read.rig.imus[i], &b = document.rig.imus[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.rate_hz, b.rate_hz);
    expect_same_triad(a.gyroscope, b.gyroscope);
    expect_same_triad(a.accelerometer, b.accelerometer);
    EXPECT_EQ(a.gyroscope.g_sensitivity, b.gyroscope.g_sensitivity);
    expect_same_noise(a.noise.gyro, b.noise.gyro);
    expect_same_noise(a.noise.accel, b.noise.accel);
  }
  ASSERT_EQ(read.rig.cameras.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) expect_same_camera(read.rig.cameras[i], document.rig.cameras[i]);
}

/// What every dialect holds: one exact IMU at the body, two cameras of its lens.
void expect_round_trip(const std::string& dialect, LensModel lens) {
  Numbers numbers(7);
  Rig rig;
  rig.imus.push_back({.name = "imu0"});
  rig.imus[0].noise = {.gyro = {1.7e-4, 1.9e-5}, .accel = {2e-3, 3e-3}};
  for (const char* name : {"cam0", "cam1"}) {
    rig.cameras.push_back(random_camera(name, lens, numbers));
    rig.cameras.back().time_offset_s = dialect == "orbslam3" ? 0.0 : -0.0034;
  }
  std::vector<std::string> notes;
  const ScratchFolder folder;
  std::vector<std::string> paths;
  for (const NamedText& file : rig_files(dialect, calibration_of(rig, notes))) {
    const std::string path = folder.write(file.file_name, file.text);
    const bool is_part = file.file_name == "cam0.yaml" || file.file_name == "cam1.yaml" || file.file_name == "imu.yaml";
    if (!is_part) paths.push_back(path);
  }
  const ReadRig read = read_rig(paths, {.imu_rate_hz = 200.0});
  SCOPED_TRACE(dialect);
  ASSERT_EQ(read.rig.imus.size(), 1U);
  EXPECT_NEAR(read.rig.imus[0].noise.gyro.white, 1.7e-4, 1e-15);
  EXPECT_NEAR(read.rig.imus[0].noise.accel.walk, 3e-3, 1e-15);
  EXPECT_EQ(read.rig.imus[0].rate_hz, 200.0);
  ASSERT_EQ(read.rig.cameras.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Camera &a = read.rig.cameras[i], &b = rig.cameras[i];
    EXPECT_EQ(a.lens.model, b.lens.model);
    EXPECT_LT((a.lens.params - b.lens.params).norm(), 1e-9);
    EXPECT_LT((a.T_c_b.R - b.T_c_b.R).norm(), 1e-6);
    EXPECT_LT((a.T_c_b.p - b.T_c_b.p).norm(), 1e-6);
    EXPECT_NEAR(a.time_offset_s, b.time_offset_s, 1e-9);
  }
}

TEST(RigFile, EveryDialectReadsBack) {
  for (int i = 0; i < 8; ++i) expect_round_trip("kalibr", static_cast<LensModel>(i));
  for (const LensModel lens : {LensModel::kPinholeRadtan, LensModel::kPinholeEquidistant}) {
    for (const char* dialect : {"openvins", "vins-fusion", "orbslam3"}) expect_round_trip(dialect, lens);
  }
  expect_round_trip("vins-fusion", LensModel::kOmniRadtan);
  for (const LensModel lens :
       {LensModel::kDoubleSphere, LensModel::kExtendedUnified, LensModel::kPinholeEquidistant, LensModel::kPinhole}) {
    expect_round_trip("basalt", lens);
  }
}

TEST(RigFile, KalibrKeepsTheWholeImu) {
  Numbers numbers(12);
  Rig rig;
  for (const char* name : {"imu0", "imu1"}) {
    Imu imu = random_imu(name, numbers);
    imu.gyroscope.T_b_i.p = imu.accelerometer.T_b_i.p;
    imu.gyroscope.time_offset_s = imu.accelerometer.time_offset_s;
    rig.imus.push_back(imu);
  }
  rig.cameras.push_back(random_camera("cam0", LensModel::kPinholeRadtan, numbers));
  std::vector<std::string> notes;
  const ScratchFolder folder;
  std::vector<std::string> paths;
  for (const NamedText& file : rig_files("kalibr", calibration_of(rig, notes))) {
    if (file.file_name != "imu.yaml") paths.push_back(folder.write(file.file_name, file.text));
  }
  const ReadRig read = read_rig(paths);
  for (std::size_t i = 0; i < 2; ++i) {
    const Imu &a = read.rig.imus[i], &b = rig.imus[i];
    EXPECT_LT((a.gyroscope.T_b_i.R - b.gyroscope.T_b_i.R).norm(), 1e-12);
    EXPECT_LT((a.accelerometer.T_b_i.R - b.accelerometer.T_b_i.R).norm(), 1e-12);
    EXPECT_LT((a.accelerometer.T_b_i.p - b.accelerometer.T_b_i.p).norm(), 1e-12);
    EXPECT_LT((a.gyroscope.scale - b.gyroscope.scale).norm(), 1e-12);
    EXPECT_LT((a.accelerometer.misalignment - b.accelerometer.misalignment).norm(), 1e-12);
    EXPECT_LT((a.gyroscope.g_sensitivity - b.gyroscope.g_sensitivity).norm(), 1e-12);
    EXPECT_EQ(a.gyroscope.time_offset_s, b.gyroscope.time_offset_s);
  }
  EXPECT_LT((read.rig.cameras[0].T_c_b.p - rig.cameras[0].T_c_b.p).norm(), 1e-12);
  EXPECT_LT((read.rig.cameras[0].T_c_b.R - rig.cameras[0].T_c_b.R).norm(), 1e-12);
}

std::string code_of(const std::string& text) {
  const ScratchFolder folder;
  try {
    read_rig({folder.write("rig.yaml", text)});
  } catch (const Error& error) {
    return error.diagnostic().code + " " + error.diagnostic().where.substr(error.diagnostic().where.rfind('/') + 1);
  }
  return "";
}

TEST(RigFile, WhatIsRefused) {
  EXPECT_EQ(code_of("vispline_rig: 2\n"), "E-CONFIG rig.yaml:1:15");
  EXPECT_EQ(code_of("vispline_rig: 1\nimus:\n  imu0:\n    rate_hz: 0\n"), "E-CONFIG rig.yaml:4:14");
  EXPECT_EQ(code_of("vispline_rig: 1\nimus:\n  imu0:\n    rate_hz: 1.0\n    gyroscope:\n      noise_density: -1\n"),
            "E-CONFIG rig.yaml:6:22");
  EXPECT_EQ(code_of("vispline_rig: 1\nestimate:\n  cam0.intrinsics: free\n"), "E-CONFIG rig.yaml:3:20");
  EXPECT_EQ(code_of("vispline_rig: 1\nestimate:\n  gravity: perhaps\n"), "E-CONFIG rig.yaml:3:12");
  EXPECT_EQ(code_of("vispline_rig: 1\nestimate:\n  gravity: {sigma: 0}\n"), "E-CONFIG rig.yaml:3:20");
}

TEST(RigFile, TwoSensorsOfOneName) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.yaml", "vispline_rig: 1\nimus:\n  imu0:\n    rate_hz: 100.0\n");
  EXPECT_THROW(read_rig({path, path}), Error);
}

TEST(RigFile, PresetsReadBack) {
  const ScratchFolder folder;
  ASSERT_EQ(rig_preset_names().size(), 4U);
  for (const std::string& name : rig_preset_names()) {
    const RigDocument preset = *rig_preset(name);
    const std::string path = folder.path(name + ".yaml");
    write_rig(path, preset);
    const ReadRig read = read_rig({path});
    ASSERT_EQ(read.rig.cameras.size(), preset.rig.cameras.size());
    for (std::size_t i = 0; i < read.rig.cameras.size(); ++i) {
      expect_same_camera(read.rig.cameras[i], preset.rig.cameras[i]);
      const Camera& camera = read.rig.cameras[i];
      const auto ahead_c = camera.lens.unproject(Vector2d(camera.resolution_px[0], camera.resolution_px[1]) / 2.0);
      const double ahead = (camera.T_c_b.inverse().R * ahead_c.value()).x();
      EXPECT_GT(name == "course" ? -ahead : ahead, 0.95) << name;
    }
  }
  EXPECT_FALSE(rig_preset("no such rig").has_value());
}

TEST(RigFile, SensorYamlOfEurocIsRead) {
  const ScratchFolder folder;
  const Imu imu = rig_preset("euroc-stereo")->rig.imus[0];
  const ReadRig read = read_rig({folder.write("sensor.yaml", euroc_folder::imu_yaml(imu))});
  ASSERT_EQ(read.rig.imus.size(), 1U);
  expect_same_noise(read.rig.imus[0].noise.gyro, {.white = imu.noise.gyro.white, .walk = imu.noise.gyro.walk});
  expect_same_noise(read.rig.imus[0].noise.accel, {.white = imu.noise.accel.white, .walk = imu.noise.accel.walk});
}

TEST(RigFile, Recorded) {
  SKIP_IF_ABSENT();
  const ReadRig read = read_rig({data("noncommercial/tumvi_calib_imu1_first31s/initial_calibration.json")});
  ASSERT_EQ(read.rig.cameras.size(), 2U);
  ASSERT_EQ(read.rig.imus.size(), 1U);
  EXPECT_EQ(read.rig.imus[0].noise.accel.white, 0.016);
  EXPECT_EQ(read.rig.imus[0].noise.gyro.walk, 0.0001);
  const Lens& lens = read.rig.cameras[1].lens;
  EXPECT_EQ(lens.model, LensModel::kDoubleSphere);
  const double expected[] = {-0.17114391523517878, 0.5925534893639901, 157.9185887809557,
                             157.89064156492609,   252.56377167627199, 255.02662654441773};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(lens.params[i], expected[i]);
  const Pose T_b_c1 = read.rig.cameras[1].T_c_b.inverse();
  EXPECT_NEAR(T_b_c1.p.x(), -0.10108693561883726, 1e-15);
}

TEST(RigFile, RecordedInSeveralFiles) {
  SKIP_IF_ABSENT();
  const ReadRig uzh = read_rig(
      {data("kalibr_files/uzhfpv_snapdragon-camchain-imucam.yaml"), data("kalibr_files/uzhfpv_snapdragon-imu.yaml")});
  EXPECT_EQ(uzh.rig.cameras.size(), 2U);
  EXPECT_EQ(uzh.rig.imus.size(), 1U);
  const ReadRig tum = read_rig({data("kalibr_files/open_vins_tum_vi_kalibr_imucam_chain.yaml"),
                                data("kalibr_files/open_vins_tum_vi_kalibr_imu_chain.yaml")});
  EXPECT_EQ(tum.formats, (std::vector<std::string>{"openvins", "openvins"}));
  EXPECT_EQ(tum.rig.cameras.size(), 2U);
}

}  // namespace
}  // namespace vispline
