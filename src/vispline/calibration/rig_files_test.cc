#include "vispline/calibration/rig_files.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <map>

#include "vispline/calibration/failure_testing.h"

namespace vispline {
namespace {

Pose pose(double seed) {
  const Vector3d axis = Vector3d(std::sin(seed), std::cos(3 * seed), 0.3).normalized();
  return {Eigen::AngleAxisd(0.7 + seed, axis).toRotationMatrix(), Vector3d(0.1 * seed, -0.05, 0.02 + seed)};
}

CameraCalibration camera(const std::string& model, const std::string& distortion, double seed) {
  static const std::map<std::string, std::vector<double>> kBefore = {
      {"pinhole", {}}, {"omni", {1.2}}, {"ds", {-0.17, 0.59}}, {"eucm", {0.6, 1.1}}};
  CameraCalibration value{.model = model, .distortion_model = distortion};
  value.intrinsics = kBefore.at(model);
  for (const double number : {458.654, 460.0, 367.215, 248.375 + seed}) value.intrinsics.push_back(number);
  if (distortion == "fov") value.distortion = {0.93};
  if (distortion == "radtan" || distortion == "equidistant") value.distortion = {-0.28, 0.07 + seed, 1.9e-5, -1.7e-4};
  value.resolution_px = {752, 480};
  value.T_cam_imu = pose(seed);
  value.timeshift_cam_imu = -0.003426703;
  value.topic = "/cam/image raw";
  return value;
}

RigCalibration rig_of(const std::string& model, const std::string& distortion) {
  RigCalibration rig;
  rig.cameras = {camera(model, distortion, 0.1), camera(model, distortion, 0.4)};
  rig.cameras[1].name = "cam1";
  rig.cameras[1].T_cn_cnm1 = *rig.cameras[1].T_cam_imu * rig.cameras[0].T_cam_imu->inverse();
  ImuCalibration imu;
  imu.noise.gyro_white = 1.6968e-4;
  imu.noise.accel_white = 2e-3;
  imu.noise.gyro_walk.value = 1.9e-5;
  imu.noise.accel_walk.value = 3e-3;
  imu.noise.rate_hz = 200.0;
  rig.imus = {imu};
  return rig;
}

struct Read {
  RigCalibration rig;
  Diagnostics diagnostics;
  std::string dialects;
};

/// All files of a set; a file that another one names is read through it only.
Read read_all(const std::vector<NamedText>& files, double rate_hz) {
  std::map<std::string, std::string> by_name;
  for (const NamedText& file : files) by_name[file.file_name] = file.text;
  Read all;
  for (const NamedText& file : files) {
    if (file.file_name == "cam0.yaml" || file.file_name == "cam1.yaml" || file.file_name == "imu.yaml") continue;
    const auto sibling = [&](const std::string& name) { return by_name.at(name); };
    RigReading one = parse_rig(file.file_name, file.text, sibling, {.rate_hz = rate_hz});
    for (const auto& value : one.rig.cameras) all.rig.cameras.push_back(value);
    for (const auto& value : one.rig.imus) all.rig.imus.push_back(value);
    all.diagnostics.merge(one.diagnostics);
    all.dialects += one.dialect + " ";
  }
  return all;
}

void expect_near(const Pose& a, const Pose& b, double slack) {
  EXPECT_LE((a.R - b.R).cwiseAbs().maxCoeff(), slack);
  EXPECT_LE((a.p - b.p).cwiseAbs().maxCoeff(), slack);
}

void expect_same(const RigCalibration& wrote, const RigCalibration& read, double slack) {
  ASSERT_EQ(read.cameras.size(), wrote.cameras.size());
  for (std::size_t i = 0; i < wrote.cameras.size(); ++i) {
    const CameraCalibration &a = wrote.cameras[i], &b = read.cameras[i];
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.model, a.model);
    EXPECT_EQ(b.intrinsics, a.intrinsics);
    EXPECT_EQ(b.distortion_model, a.distortion_model);
    EXPECT_EQ(b.distortion, a.distortion);
    EXPECT_EQ(b.resolution_px, a.resolution_px);
    ASSERT_TRUE(imu_to_camera(read, i).has_value());
    expect_near(*imu_to_camera(read, i), *imu_to_camera(wrote, i), slack);
  }
  ASSERT_EQ(read.imus.size(), 1u);
  EXPECT_NEAR(read.imus[0].noise.gyro_white, wrote.imus[0].noise.gyro_white, 1e-18);
  EXPECT_NEAR(*read.imus[0].noise.accel_walk.value, *wrote.imus[0].noise.accel_walk.value, 1e-17);
}

struct Case {
  const char *dialect, *model, *distortion;
};

class Written : public ::testing::TestWithParam<Case> {};

TEST_P(Written, ReadsBack) {
  const Case& c = GetParam();
  const RigCalibration wrote = rig_of(c.model, c.distortion);
  const auto files = rig_files(c.dialect, wrote);
  const Read read = read_all(files, 200.0);
  EXPECT_EQ(read.dialects.substr(0, read.dialects.find(' ')), c.dialect);
  const bool is_exact = c.dialect == std::string("kalibr") || c.dialect == std::string("openvins");
  expect_same(wrote, read.rig, is_exact ? 0.0 : 3e-15);
  EXPECT_TRUE(read.diagnostics.empty()) << to_text(read.diagnostics.examples().front());
  if (c.dialect == std::string("orbslam3")) return;  // knows no time shift
  EXPECT_NEAR(*read.rig.cameras[0].timeshift_cam_imu, -0.003426703, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(
    Rig, Written,
    ::testing::Values(Case{"kalibr", "pinhole", "radtan"}, Case{"kalibr", "omni", "none"}, Case{"kalibr", "ds", "none"},
                      Case{"kalibr", "eucm", "none"}, Case{"kalibr", "pinhole", "fov"},
                      Case{"openvins", "pinhole", "radtan"}, Case{"openvins", "pinhole", "equidistant"},
                      Case{"vins-fusion", "pinhole", "radtan"}, Case{"vins-fusion", "omni", "radtan"},
                      Case{"vins-fusion", "pinhole", "equidistant"}, Case{"orbslam3", "pinhole", "radtan"},
                      Case{"orbslam3", "pinhole", "none"}, Case{"orbslam3", "pinhole", "equidistant"},
                      Case{"basalt", "ds", "none"}, Case{"basalt", "eucm", "none"},
                      Case{"basalt", "pinhole", "equidistant"}, Case{"basalt", "pinhole", "none"}));

TEST(RigFiles, KalibrKeepsEverything) {
  RigCalibration wrote = rig_of("pinhole", "radtan");
  wrote.cameras[0].line_delay = 2.7e-5;
  wrote.cameras[0].overlaps = {1};
  wrote.imus.push_back(wrote.imus[0]);
  ImuCalibration& imu = wrote.imus[1];
  imu.T_i_b = pose(0.9);
  imu.time_offset = 0.001;
  imu.gyro_M << 1.01, 0, 0, 0.002, 0.99, 0, -0.003, 0.004, 1.02;
  imu.accel_M = imu.gyro_M * 1.001;
  imu.gyro_A = imu.gyro_M * 1e-4;
  imu.R_gyro_imu = pose(0.3).R;
  const RigCalibration read = read_all(rig_files("kalibr", wrote), 200.0).rig;
  EXPECT_EQ(read.cameras[0].line_delay, 2.7e-5);
  EXPECT_EQ(read.cameras[0].overlaps, std::vector<int>{1});
  EXPECT_EQ(read.cameras[1].topic, "/cam/image raw");
  expect_near(*read.cameras[1].T_cn_cnm1, *wrote.cameras[1].T_cn_cnm1, 0.0);
  ASSERT_EQ(read.imus.size(), 2u);
  EXPECT_EQ(read.imus[1].gyro_M, imu.gyro_M);
  EXPECT_EQ(read.imus[1].accel_M, imu.accel_M);
  EXPECT_EQ(read.imus[1].gyro_A, imu.gyro_A);
  EXPECT_EQ(read.imus[1].R_gyro_imu, imu.R_gyro_imu);
  EXPECT_EQ(read.imus[1].time_offset, 0.001);
  expect_near(read.imus[1].T_i_b, imu.T_i_b, 0.0);
  wrote.imus.erase(wrote.imus.begin());
  wrote.imus[0].R_accel_imu = pose(0.2).R;
  const RigCalibration openvins = read_all(rig_files("openvins", wrote), 200.0).rig;
  EXPECT_EQ(openvins.imus[0].gyro_M, imu.gyro_M);
  EXPECT_EQ(openvins.imus[0].R_accel_imu, wrote.imus[0].R_accel_imu);
}

// A camera at (1, 2, 3) in the IMU that looks along its x axis: x_c = -y_i, y_c = -z_i, z_c = x_i.
TEST(RigFiles, DirectionsOfTheTransforms) {
  RigCalibration rig = rig_of("pinhole", "radtan");
  rig.cameras.resize(1);
  Pose T_imu_cam;
  T_imu_cam.R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_imu_cam.p << 1, 2, 3;
  rig.cameras[0].T_cam_imu = T_imu_cam.inverse();
  const auto text = [&](const char* dialect) { return rig_files(dialect, rig)[0].text; };
  const auto holds = [&](const char* dialect, const char* part) {
    return text(dialect).find(part) != std::string::npos;
  };
  EXPECT_TRUE(holds("kalibr",
                    "T_cam_imu:  # IMU to camera, m\n    - [0.0, -1.0, 0.0, 2.0]\n    - [0.0, 0.0, -1.0, 3.0]\n"
                    "    - [1.0, 0.0, 0.0, -1.0]\n"))
      << text("kalibr");
  for (const char* dialect : {"vins-fusion", "orbslam3"}) {
    EXPECT_TRUE(
        holds(dialect, "data: [0.0, 0.0, 1.0, 1.0,\n          -1.0, 0.0, 0.0, 2.0,\n          0.0, -1.0, 0.0, 3.0,"))
        << text(dialect);
  }
  rig.cameras[0].distortion_model = "none";
  rig.cameras[0].distortion.clear();
  EXPECT_TRUE(holds("basalt", "\"px\": 1.0, \"py\": 2.0, \"pz\": 3.0, ")) << text("basalt");
}

TEST(RigFiles, WhatIsLostIsSaid) {
  RigCalibration rig = rig_of("pinhole", "equidistant");
  rig.cameras[0].line_delay = 1e-5;
  rig.cameras[1].timeshift_cam_imu = 0.01;
  rig.imus[0].gyro_M(0, 0) = 1.1;
  for (const char* dialect : {"vins-fusion", "orbslam3", "basalt"}) {
    std::string notes;
    const auto files = rig_files(dialect, rig);
    for (const std::string& note : files[0].notes) notes += note + "\n";
    for (const char* part : {"line delay of cam0 is lost", "cam1 has 0.01 s", "misalignment of the IMU"}) {
      EXPECT_NE(notes.find(part), std::string::npos) << dialect << "\n" << notes;
    }
  }
}

TEST(RigFiles, WritersRefuseWhatATemplateCannotHold) {
  const auto write = [](const char* dialect, const RigCalibration& rig) {
    return failure_of([&] { rig_files(dialect, rig); });
  };
  EXPECT_NE(write("openvins", rig_of("ds", "none")).find("OpenVINS knows pinhole"), std::string::npos);
  EXPECT_NE(write("basalt", rig_of("pinhole", "radtan")).find("Basalt knows"), std::string::npos);
  EXPECT_NE(write("orbslam3", rig_of("omni", "radtan")).find("ORB-SLAM3 knows"), std::string::npos);
  EXPECT_NE(write("vins-fusion", rig_of("eucm", "none")).find("VINS-Fusion knows"), std::string::npos);
  EXPECT_NE(write("nobody", rig_of("ds", "none")).find("unknown kind"), std::string::npos);
  RigCalibration rig = rig_of("pinhole", "radtan");
  rig.cameras.push_back(rig.cameras[0]);
  EXPECT_NE(write("orbslam3", rig).find("1 to 2 cameras, the rig has 3"), std::string::npos);
  rig.cameras.resize(1);
  rig.cameras[0].T_cam_imu.reset();
  EXPECT_NE(write("vins-fusion", rig).find("has no T_cam_imu"), std::string::npos);
  EXPECT_EQ(write("kalibr", rig), "");
  rig.cameras[0].intrinsics[0] = -1;
  EXPECT_NE(write("kalibr", rig).find("fu is -1"), std::string::npos);
}

TEST(RigFiles, VinsCameraFilesStayInTheFolder) {
  const std::string config = rig_files("vins-fusion", rig_of("pinhole", "radtan"))[0].text;
  for (const char* name : {"../cam0.yaml", "/etc/passwd", "a/b.yaml", "", ".hidden"}) {
    std::string text = config;
    text.replace(text.find("cam0.yaml"), 9, name);
    EXPECT_TRUE(
        failure_of([&] { parse_rig("f", text, [](const std::string&) { return ""; }); }).starts_with("E-PATH f:"))
        << name;
  }
}

TEST(RigFiles, RecordedFiles) {
  const std::string folder = std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/kalibr_files/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recorded data at hand";
  const auto read = [&](const char* name) { return read_rig_file(folder + name); };
  const RigReading mynteye = read("mynteye_s1030-camchain-imucam.yaml");
  EXPECT_EQ(mynteye.dialect, "kalibr");
  EXPECT_EQ(mynteye.rig.cameras.at(1).timeshift_cam_imu, 0.003185970669502835);
  EXPECT_EQ(mynteye.diagnostics.examples().at(0).message, "unknown key 'T_imu_body'");
  const RigReading snapdragon = read("uzhfpv_snapdragon-camchain-imucam.yaml");
  EXPECT_TRUE(snapdragon.diagnostics.empty());
  const CameraCalibration& right = snapdragon.rig.cameras.at(1);
  EXPECT_EQ(right.distortion.at(3), 0.0015368127092821786);
  EXPECT_EQ(right.topic, "/snappy_cam/stereo_r");
  expect_near(*right.T_cam_imu, *right.T_cn_cnm1 * *snapdragon.rig.cameras[0].T_cam_imu, 1e-9);  // as Kalibr means it
  const RigReading tum = read("open_vins_tum_vi_kalibr_imucam_chain.yaml");
  EXPECT_EQ(tum.dialect, "openvins");
  EXPECT_EQ(tum.rig.cameras.size(), 2u);
  EXPECT_EQ(read("open_vins_rs_d455_kalibr_imucam_chain.yaml").rig.cameras.at(0).resolution_px[0], 848);
  EXPECT_EQ(read("open_vins_kaist_vio_kalibr_imucam_chain.yaml").rig.cameras.at(1).intrinsics.at(0),
            380.95187095303424);
  EXPECT_EQ(read("open_vins_kaist_vio_kalibr_imu_chain.yaml").rig.imus.at(0).noise.rate_hz, 100.0);
  const RigReading basalt = read("basalt_tumvi_512_ds_calib.json");
  EXPECT_TRUE(basalt.diagnostics.empty());
  EXPECT_EQ(basalt.rig.cameras.at(0).intrinsics.at(0), -0.17213086034353243);
  // The same device by two tools: TUM-VI's first camera.
  expect_near(*basalt.rig.cameras[0].T_cam_imu, *tum.rig.cameras[0].T_cam_imu, 0.01);
}

}  // namespace
}  // namespace vispline
