#include "vispline/calibration/rig_checks.h"

#include <gtest/gtest.h>

#include "vispline/calibration/failure_testing.h"
#include "vispline/calibration/rig_files.h"

namespace vispline {
namespace {

/// A chain of Kalibr with one thing changed.
class KalibrChain : public ::testing::Test {
 protected:
  std::string failure_with(const std::string& from, const std::string& to) {
    const std::size_t at = text_.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    std::string text = text_;
    text.replace(at, from.size(), to);
    return failure_of([&] { reading_ = parse_rig("f", text, {}); });
  }
  std::string text_ =
      "cam0:\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, 0.1]\n  - [0.0, 1.0, 0.0, 0.2]\n  - [0.0, 0.0, 1.0, 0.3]\n"
      "  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n  distortion_coeffs: [0.1, 0.2, 0.3, 0.4]\n"
      "  distortion_model: radtan\n  intrinsics: [460.0, 461.0, 255.0, 256.0]\n  resolution: [640, 480]\n";
  RigReading reading_;
};

TEST_F(KalibrChain, RotationsOfRow54) {
  EXPECT_EQ(failure_with("[1.0, 0.0, 0.0, 0.1]", "[1.0, 0.0, 0.0, 0.1]"), "");
  EXPECT_TRUE(reading_.diagnostics.empty());
  EXPECT_EQ(failure_with("[1.0, 0.0, 0.0, 0.1]", "[1.0000004, 0.0, 0.0, 0.1]"), "");  // off by 8e-7
  EXPECT_TRUE(reading_.diagnostics.empty());
  EXPECT_EQ(reading_.rig.cameras[0].T_cam_imu->R(0, 0), 1.0000004);
  EXPECT_EQ(failure_with("[1.0, 0.0, 0.0, 0.1]", "[1.0004, 0.0, 0.0, 0.1]"), "");  // off by 8e-4
  EXPECT_EQ(reading_.diagnostics.counts().at("W-CONFIG"), 1);
  EXPECT_NEAR(reading_.rig.cameras[0].T_cam_imu->R(0, 0), 1.0, 1e-15);
  EXPECT_EQ(failure_with("[1.0, 0.0, 0.0, 0.1]", "[1.0006, 0.0, 0.0, 0.1]"),
            "E-CONFIG f:3:3 cam0.T_cam_imu is not a rotation: R^T R is off by 0.00120036");
  EXPECT_EQ(failure_with("[1.0, 0.0, 0.0, 0.1]", "[-1.0, 0.0, 0.0, 0.1]"),
            "E-CONFIG f:3:3 cam0.T_cam_imu is a reflection: its determinant is -1");
  EXPECT_EQ(failure_with("[0.0, 0.0, 0.0, 1.0]", "[0.0, 0.0, 0.1, 1.0]"),
            "E-CONFIG f:3:3 cam0.T_cam_imu has a last row that is not 0 0 0 1");
}

TEST_F(KalibrChain, NumbersOfRows52To54) {
  EXPECT_EQ(failure_with("[460.0,", "[-460.0,"),
            "E-CONFIG f:10:15 cam0.intrinsics cannot be: fu is -460, expected a positive number of px");
  EXPECT_EQ(failure_with("[460.0, 461.0,", "[461.0,"),
            "E-CONFIG f:10:15 cam0.intrinsics cannot be: 3 camera parameters, pinhole has 4");
  EXPECT_EQ(failure_with("0.3, 0.4]", "0.3]"),
            "E-CONFIG f:10:15 cam0.intrinsics cannot be: 3 distortion parameters, radtan has 4");
  EXPECT_NE(failure_with("radtan", "plumb_bob").find("unknown distortion model 'plumb_bob'"), std::string::npos);
  EXPECT_NE(failure_with("[640,", "[0,").find("a resolution of 0 px, expected 1 to 65535"), std::string::npos);
  EXPECT_NE(failure_with("[640,", "[65536,").find("a resolution of 65536 px"), std::string::npos);
  EXPECT_NE(failure_with("[640, 480]", "[640]").find("has 1 numbers"), std::string::npos);
  EXPECT_NE(failure_with("[640, 480]", "[640.5, 480]").find("expected a whole number"), std::string::npos);
  EXPECT_NE(failure_with("  camera_model: pinhole\n", "").find("key cam0.camera_model is missing"), std::string::npos);
  EXPECT_EQ(failure_with("cam0:\n", "cam0:\n  colour: 1\n"), "");
  EXPECT_EQ(reading_.diagnostics.examples().at(0).message, "unknown key 'cam0.colour'");
  EXPECT_NE(failure_with("cam0:", "cam7:").find("no camera or IMU in the file"), std::string::npos);
}

}  // namespace
}  // namespace vispline
