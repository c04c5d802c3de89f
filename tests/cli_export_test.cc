// vispline export: where files go, what is said, and how it refuses.
#include <nlohmann/json.hpp>

#include "program.h"

namespace vispline {
namespace {

const char* const kCamchain =
    "cam0:\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, 0.1]\n  - [0.0, 1.0, 0.0, 0.2]\n  - [0.0, 0.0, 1.0, 0.3]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n  distortion_coeffs: [0.1, 0.2, 0.003, 0.004]\n"
    "  distortion_model: radtan\n  intrinsics: [460.0, 461.0, 255.0, 256.0]\n  resolution: [640, 480]\n"
    "  timeshift_cam_imu: 0.0025\n  line_delay: 2.0e-05\n";
const char* const kImu =
    "accelerometer_noise_density: 2.0e-03\naccelerometer_random_walk: 3.0e-04\ngyroscope_noise_density: 1.0e-04\n"
    "gyroscope_random_walk: 1.0e-05\nrostopic: /imu0\nupdate_rate: 200.0\n";

class CliExport : public ::testing::Test {
 protected:
  CliExport() {
    program_.write("cams.yaml", kCamchain);
    program_.write("imu.yaml", kImu);
  }
  Program program_;
};

TEST_F(CliExport, EveryToolEndsWithItsCommand) {
  for (const std::string tool : {"kalibr", "openvins", "vins-fusion", "orbslam3", "gyroflow"}) {
    SCOPED_TRACE(tool);
    const std::string out = "out/" + tool + "/calibration.yaml";
    const ProgramRun run = program_.run("export cams.yaml --imu imu.yaml --for " + tool + " --out " + out);
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_TRUE(program_.exists(out));
    const auto said = lines(run.out);
    EXPECT_EQ(said.front(), "wrote " + out);
    EXPECT_EQ(said.back().find("next: "), 0u);
    const std::string file = tool == "openvins" ? "estimator_config.yaml" : out;  // which includes what was written
    EXPECT_NE(said.back().find(file), std::string::npos) << said.back();
  }
  EXPECT_TRUE(program_.exists("out/vins-fusion/cam0.yaml"));
}

TEST_F(CliExport, BakedTimeshift) {
  const ProgramRun run =
      program_.run("export cams.yaml --imu imu.yaml --for orbslam3 --out orb.yaml --bake-timeshift --json");
  ASSERT_EQ(run.exit, 0) << run.err;
  const auto document = nlohmann::json::parse(run.out);
  EXPECT_EQ(document["schema"], "vispline.export/1");
  EXPECT_NE(document["first"][0]["step"].get<std::string>().find("add 2500000 ns"), std::string::npos);
  EXPECT_EQ(document["files"][0]["path"], "orb.yaml");
  EXPECT_NE(document["next_command"].get<std::string>().find("orb.yaml"), std::string::npos);
}

TEST_F(CliExport, Refusals) {
  EXPECT_EQ(program_.run("export cams.yaml --for basalt --out b.json").exit, 2);  // knows no radtan
  EXPECT_EQ(program_.run("export cams.yaml --for nobody --out b.json").exit, 2);
  EXPECT_EQ(program_.run("export absent.yaml --for kalibr --out b.yaml").exit, 3);
  program_.write("there.yaml", "old");
  const ProgramRun run = program_.run("export cams.yaml --for gyroflow --out there.yaml");
  EXPECT_EQ(run.exit, 6);
  EXPECT_EQ(program_.bytes("there.yaml"), "old");
  EXPECT_FALSE(program_.exists("b.json"));
}

}  // namespace
}  // namespace vispline
