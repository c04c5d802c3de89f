// Motion capture to synthetic IMU to the measured IMU, on public recordings; skipped where they are not at hand.
#include <nlohmann/json.hpp>

#include "program.h"

namespace vispline {
namespace {

using nlohmann::json;

const std::string kData = std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/trajectory_imu/";

json evaluated(const Program& program, const std::string& poses, const std::string& imu, const std::string& flags,
               const std::string& evaluate_flags) {
  const ProgramRun simulated =
      program.run("simulate --trajectory " + poses + " --like " + imu + " --noise none --out synth.csv " + flags);
  EXPECT_EQ(simulated.exit, 0) << simulated.err;
  const ProgramRun run = program.run("evaluate synth.csv " + imu + " --json " + evaluate_flags);
  EXPECT_EQ(run.exit, 0) << run.err;
  return json::parse(run.out);
}

void expect_close(const json& result, double gyro_rms, double accel_rms, double offset_s, double rotation_deg) {
  for (const json& axis : result["gyroscope"]) EXPECT_LT(axis["rms_rad_per_s"].get<double>(), gyro_rms) << axis;
  for (const json& axis : result["accelerometer"]) EXPECT_LT(axis["rms_m_per_s2"].get<double>(), accel_rms) << axis;
  EXPECT_LT(std::abs(result["time_offset_s"].get<double>()), offset_s);
  EXPECT_LT(result["rotation_deg"].get<double>(), rotation_deg);
}

TEST(RealData, TumViRoom1) {
  const std::string poses = kData + "tumvi_room1/mocap0.csv.xz", imu = kData + "tumvi_room1/imu0.csv.xz";
  if (!std::filesystem::exists(poses)) GTEST_SKIP() << poses;
  const Program program;
  expect_close(evaluated(program, poses, imu, "", ""), 0.05, 0.2, 3e-3, 0.5);
}

TEST(RealData, BroadFastTranslation) {
  const std::string trial = kData + "broad/16_undisturbed_fast_translation_B.csv.xz";
  if (!std::filesystem::exists(trial)) GTEST_SKIP() << trial;
  const Program program;
  const std::string unit = "--time-unit index@2000/7";
  expect_close(evaluated(program, trial, trial, unit + " --repair", "--time-unit auto " + unit + " --repair"), 0.1, 0.5,
               6e-3, 2.0);
}

}  // namespace
}  // namespace vispline
