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
  /// out/, with a file that is no calibration of a result.
  void make_folder() { ASSERT_EQ(program_.run("export cams.yaml --for gyroflow --out out/").exit, 0); }
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

/// What calibrate and estimate leave: their rig file beside result.json.
TEST_F(CliExport, FolderOfAResult) {
  ASSERT_EQ(program_.run("simulate --trajectory ellipse --rig phone --duration 0.2 --out rec").exit, 0);
  make_folder();
  program_.write("out/rig.yaml", program_.bytes("rec/rig.yaml"));
  program_.write("out/result.json", "{}");
  for (const std::string from : {"out", "out/result.json", "rec/rig.yaml"}) {
    for (const std::string tool : {"kalibr", "openvins", "vins-fusion", "orbslam3", "gyroflow"}) {
      SCOPED_TRACE(from + " for " + tool);
      const ProgramRun run = program_.run("export " + from + " --for " + tool + " -f --out files/");
      ASSERT_EQ(run.exit, 0) << run.err;
      EXPECT_EQ(lines(run.out).back().find("next: "), 0u);
    }
  }
  EXPECT_NE(program_.bytes("files/camchain.yaml").find("line_delay"), std::string::npos);
  const ProgramRun info = program_.run("info out --json");
  ASSERT_EQ(info.exit, 0) << info.err;
  const auto document = nlohmann::json::parse(info.out);
  EXPECT_EQ(document["dialect"], "vispline");
  EXPECT_NEAR(document["parts"][0]["readout_s"].get<double>(), 0.030, 1e-9);  // what the preset is made of
}

TEST_F(CliExport, ResultThatIsNotToBeTrusted) {
  make_folder();
  program_.write("out/result.json", "{}");
  EXPECT_EQ(program_.run("export out --for kalibr --out k/").exit, 3);
  program_.write("out/walk.rejected.yaml", "# class: not-converged\n");
  for (const std::string from : {"out", "out/result.json"}) {
    const ProgramRun run = program_.run("export " + from + " --for kalibr --out k/");
    EXPECT_EQ(run.exit, 5);
    EXPECT_NE(run.err.find("error[E-REJECTED]: "), std::string::npos) << run.err;
  }
  EXPECT_EQ(program_.run("export nowhere/result.json --for kalibr --out k/").exit, 3);
  EXPECT_FALSE(program_.exists("k"));
}

/// Kalibr divides by the random walk: where there is none, its file has none, and says so.
TEST_F(CliExport, RigWithoutRandomWalk) {
  ASSERT_EQ(program_.run("simulate --trajectory ellipse --rig phone --duration 0.2 --out rec").exit, 0);
  std::string rig = program_.bytes("rec/rig.yaml");
  for (std::size_t at = 0; (at = rig.find("random_walk: ", at)) != std::string::npos; at += 13) {
    rig.replace(at + 13, rig.find(' ', at + 13) - at - 13, "0.0");
  }
  program_.write("still.yaml", rig);
  const ProgramRun run = program_.run("simulate --trajectory ellipse --rig still.yaml --duration 0.2 --out still");
  ASSERT_EQ(run.exit, 0) << run.err;
  EXPECT_NE(run.err.find("warning[W-KALIBR]: "), std::string::npos) << run.err;
  const std::string imu = program_.bytes("still/kalibr/imu.yaml");
  EXPECT_NE(imu.find("# gyroscope_random_walk: no value above 0 is known"), std::string::npos) << imu;
  EXPECT_NE(imu.find("\ngyroscope_noise_density: "), std::string::npos) << imu;
}

}  // namespace
}  // namespace vispline
