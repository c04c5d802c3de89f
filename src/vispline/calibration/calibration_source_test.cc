#include "vispline/calibration/calibration_source.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

namespace vispline {
namespace {

namespace fs = std::filesystem;

class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "vispline_calibration_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Scratch() { fs::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ + "/" + name) << text;
    return path_ + "/" + name;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

RigCalibration small_rig() {
  RigCalibration rig;
  rig.cameras.resize(1);
  CameraCalibration& camera = rig.cameras[0];
  camera.intrinsics = {460.5, 461.25, 319.75, 241.125};
  camera.distortion_model = "equidistant";
  camera.distortion = {-0.01, 0.02, -0.003, 0.0004};
  camera.resolution_px = {640, 480};
  camera.T_cam_imu =
      Pose{Eigen::AngleAxisd(0.4, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(), {0.1, 0.2, -0.3}};
  camera.timeshift_cam_imu = -0.0123456789;
  camera.line_delay = 3.25e-5;
  rig.imus.resize(1);
  rig.imus[0].noise.gyro_white = 1.7e-4;
  rig.imus[0].noise.accel_white = 2e-3;
  rig.imus[0].noise.gyro_walk.value = 2e-5;
  rig.imus[0].noise.accel_walk.value = 3e-3;
  rig.imus[0].noise.rate_hz = 200.0;
  return rig;
}

std::string code_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.diagnostic().code;
  }
  return "";
}

TEST(CalibrationSource, FolderOfAResult) {
  const Scratch folder;
  EXPECT_EQ(code_of([&] { read_calibration(folder.path()); }), "E-OPEN");
  const auto files = rig_files("kalibr", small_rig());
  folder.write("run-camchain-imucam.yaml", files[0].text);
  EXPECT_TRUE(read_calibration(folder.path()).reading.rig.imus.empty());
  folder.write("run-imu.yaml", files[1].text);
  const CalibrationSource both = read_calibration(folder.path());
  ASSERT_EQ(both.paths.size(), 2u);
  EXPECT_EQ(both.reading.rig.imus.at(0).noise.gyro_white, 1.7e-4);
  folder.write("other-camchain-imucam.yaml", files[0].text);
  EXPECT_EQ(code_of([&] { read_calibration(folder.path()); }), "E-OPEN");  // which one?
  folder.write("rig.yaml", files[0].text + files[1].text);
  const CalibrationSource rig = read_calibration(folder.write("result.json", "{}"));
  EXPECT_EQ(rig.reading.rig.cameras.at(0).intrinsics, small_rig().cameras[0].intrinsics);
  EXPECT_EQ(rig.reading.rig.imus.size(), 1u);
}

TEST(CalibrationSource, ResultThatIsNotToBeTrusted) {
  const Scratch folder;
  EXPECT_EQ(code_of([&] { calibration_file_of(folder.path() + "/result.json"); }), "E-OPEN");
  const std::string json = folder.write("result.json", "{}");
  EXPECT_EQ(code_of([&] { calibration_file_of(json); }), "E-OPEN");
  folder.write("walk.rejected.yaml", "# class: rank-deficient\n");
  EXPECT_EQ(code_of([&] { calibration_file_of(json); }), "E-REJECTED");
  EXPECT_EQ(code_of([&] { calibration_file_of(folder.path()); }), "E-REJECTED");
  const std::string rig = folder.write("rig.yaml", "x: 1\n");
  EXPECT_EQ(calibration_file_of(json), rig);
}

TEST(CalibrationSource, ImuOfAnotherFile) {
  const Scratch folder;
  const auto files = rig_files("kalibr", small_rig());
  const std::string cameras = folder.write("cams.yaml", files[0].text);
  const std::string imu = folder.write("noise.yaml", files[2].text);
  EXPECT_TRUE(read_calibration(cameras).reading.rig.imus.empty());
  EXPECT_EQ(read_calibration(cameras, imu).reading.rig.imus.at(0).noise.rate_hz, 200.0);
}

TEST(BakeTimeshift, ShiftBecomesAStep) {
  RigCalibration rig = small_rig();
  const auto steps = bake_timeshift(rig);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NE(steps[0].find("add -12345679 ns to every stamp of the images of cam0"), std::string::npos) << steps[0];
  EXPECT_EQ(rig.cameras[0].timeshift_cam_imu, 0.0);
  EXPECT_TRUE(bake_timeshift(rig).empty());
}

TEST(GyroflowProfile, LensAndReadoutTime) {
  const RigCalibration wrote = small_rig();
  const auto files = rig_files("gyroflow", wrote);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_NE(files[0].text.find("\"frame_readout_time\": 15.6"), std::string::npos) << files[0].text;  // 480 rows, ms
  const RigReading read = parse_rig("p", files[0].text, {});
  EXPECT_EQ(read.dialect, "gyroflow");
  EXPECT_EQ(read.rig.cameras.at(0).intrinsics, wrote.cameras[0].intrinsics);
  EXPECT_EQ(read.rig.cameras[0].distortion_model, "equidistant");
  EXPECT_EQ(read.rig.cameras[0].distortion, wrote.cameras[0].distortion);
  EXPECT_EQ(read.rig.cameras[0].resolution_px, wrote.cameras[0].resolution_px);
  EXPECT_NEAR(*read.rig.cameras[0].line_delay, 3.25e-5, 1e-19);
  RigCalibration unknown = wrote;
  unknown.cameras[0].line_delay.reset();
  EXPECT_NE(rig_files("gyroflow", unknown)[0].text.find("\"frame_readout_time\": null"), std::string::npos);
  unknown.cameras[0].model = "ds";
  unknown.cameras[0].intrinsics = {-0.1, 0.5, 460, 460, 320, 240};
  unknown.cameras[0].distortion_model = "none";
  unknown.cameras[0].distortion.clear();
  EXPECT_EQ(code_of([&] { rig_files("gyroflow", unknown); }), "E-CONFIG");
}

/// What `tool` can hold of a camera, both as written and as read back.
void expect_same_camera(const std::string& tool, const RigCalibration& wrote, const RigCalibration& read,
                        std::size_t i) {
  const CameraCalibration &a = wrote.cameras[i], &b = read.cameras[i];
  EXPECT_EQ(b.model, a.model);
  EXPECT_EQ(b.intrinsics, a.intrinsics);
  EXPECT_EQ(b.resolution_px, a.resolution_px);
  if (a.distortion_model != "none") {
    EXPECT_EQ(b.distortion_model, a.distortion_model);
    EXPECT_EQ(b.distortion, a.distortion);
  }
  if (tool == "gyroflow") return;
  const double slack = tool == "kalibr" || tool == "openvins" ? 0.0 : 1e-6;  // others hold rotations that are rounded
  const auto T_a = imu_to_camera(wrote, i), T_b = imu_to_camera(read, i);
  ASSERT_TRUE(T_b.has_value());
  EXPECT_LE((T_a->R - T_b->R).cwiseAbs().maxCoeff(), slack) << tool;
  EXPECT_LE((T_a->p - T_b->p).cwiseAbs().maxCoeff(), slack) << tool;
  if (tool == "orbslam3") return;
  const double other = tool == "basalt" || tool == "vins-fusion" ? wrote.cameras[0].timeshift_cam_imu.value_or(0.0)
                                                                 : a.timeshift_cam_imu.value_or(0.0);
  EXPECT_NEAR(b.timeshift_cam_imu.value_or(0.0), other, 1e-9) << tool;
}

void expect_same_noise(const RigCalibration& wrote, const RigCalibration& read) {
  ASSERT_EQ(read.imus.size(), 1u);
  const ImuNoiseEntry &a = wrote.imus[0].noise, &b = read.imus[0].noise;
  EXPECT_NEAR(b.gyro_white / a.gyro_white, 1.0, 1e-14);
  EXPECT_NEAR(b.accel_white / a.accel_white, 1.0, 1e-14);
  if (a.gyro_walk.value) {
    EXPECT_NEAR(*b.gyro_walk.value / *a.gyro_walk.value, 1.0, 1e-14);
  }
  if (a.accel_walk.value) {
    EXPECT_NEAR(*b.accel_walk.value / *a.accel_walk.value, 1.0, 1e-14);
  }
}

/// The files of a set, read from a folder as a user would.
void write_and_read(const std::string& tool, const RigCalibration& wrote) {
  std::vector<NamedText> files;
  try {
    files = rig_files(tool, wrote);
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostic().code, "E-CONFIG");  // a lens that the tool does not know, or no T_cam_imu
    return;
  }
  const Scratch folder;
  for (const NamedText& file : files) folder.write(file.file_name, file.text);
  const double rate = wrote.imus.empty() ? 200.0 : wrote.imus[0].noise.rate_hz;
  const CalibrationSource source = read_calibration(folder.path() + "/" + files[0].file_name, "", {.rate_hz = rate});
  const RigCalibration& read = source.reading.rig;
  const std::size_t cameras = tool == "gyroflow" ? 1 : wrote.cameras.size();
  ASSERT_EQ(read.cameras.size(), cameras) << tool;
  for (std::size_t i = 0; i < cameras; ++i) expect_same_camera(tool, wrote, read, i);
  if (!wrote.imus.empty() && tool != "gyroflow") expect_same_noise(wrote, read);
}

TEST(CalibrationSource, RecordedFilesThroughEveryDialect) {
  const std::string folder = std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/kalibr_files/";
  if (!fs::exists(folder)) GTEST_SKIP() << "no recorded data at hand";
  for (const char* name : {"mynteye_s1030-camchain-imucam.yaml", "uzhfpv_snapdragon-camchain-imucam.yaml",
                           "open_vins_tum_vi_kalibr_imucam_chain.yaml", "open_vins_rs_d455_kalibr_imucam_chain.yaml",
                           "open_vins_kaist_vio_kalibr_imucam_chain.yaml", "basalt_tumvi_512_ds_calib.json"}) {
    const CalibrationSource source = read_calibration(folder + name);
    ASSERT_FALSE(source.reading.rig.cameras.empty()) << name;
    for (const std::string& tool : rig_dialects()) {
      SCOPED_TRACE(std::string(name) + " for " + tool);
      write_and_read(tool, source.reading.rig);
    }
  }
  EXPECT_EQ(read_calibration(folder + "uzhfpv_snapdragon-camchain-imucam.yaml").paths.size(), 2u);
  EXPECT_EQ(read_calibration(folder + "open_vins_tum_vi_kalibr_imucam_chain.yaml").reading.rig.imus.size(), 1u);
}

TEST(CalibrationSource, RecordedNoiseThroughEveryDialect) {
  const std::string folder = std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/kalibr_files/";
  if (!fs::exists(folder)) GTEST_SKIP() << "no recorded data at hand";
  for (const char* name : {"uzhfpv_snapdragon-imu.yaml", "open_vins_tum_vi_kalibr_imu_chain.yaml",
                           "open_vins_rs_d455_kalibr_imu_chain.yaml", "open_vins_kaist_vio_kalibr_imu_chain.yaml"}) {
    const CalibrationSource source = read_calibration(folder + name);
    ASSERT_EQ(source.reading.rig.imus.size(), 1u) << name;
    RigCalibration with_camera = small_rig();
    with_camera.imus = source.reading.rig.imus;
    for (const std::string& tool : rig_dialects()) {
      SCOPED_TRACE(std::string(name) + " for " + tool);
      write_and_read(tool, with_camera);
    }
  }
}

}  // namespace
}  // namespace vispline
