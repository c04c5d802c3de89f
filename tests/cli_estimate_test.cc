// vispline estimate and calibrate: results on small recordings, and the verdict on every recording that is wrong.
#include <dirent.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli_inputs.h"
#include "vispline/trajectory/analytic.h"

namespace vispline {
namespace {

using Json = nlohmann::json;

const std::string kDance = "simulate --trajectory dance --duration 8 --seed 3 ";

/// imu.csv: the dance at 100 Hz with noise. mocap.csv: where the body was.
void make_mocap(const Program& program) {
  ASSERT_EQ(program.run(kDance + "--imu-rate 100 --noise course --out imu.csv --truth mocap.csv").exit, 0);
}

/// bad.csv: imu.csv with every sample changed.
template <class Change>
void spoil(const Program& program, const Change& change) {
  ImuSignal imu = read_imu(program.path("imu.csv")).value;
  for (std::size_t i = 0; i < imu.size(); ++i) change(imu.time[i], imu.value[i]);
  write_imu_csv(program.path("bad.csv"), imu, {.force = true});
}

void expect_verdict(const Program& program, const std::string& code, const std::string& word) {
  const ProgramRun run = program.run("estimate bad.csv --poses mocap.csv --out out --gravity 9.81");
  EXPECT_EQ(run.exit, 4) << run.err;
  EXPECT_NE(run.err.find("error[" + code + "]"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
  EXPECT_FALSE(program.exists("out/result.json"));
}

const Json& parameter(const Json& result, const std::string& name) {
  for (const Json& p : result.at("parameters")) {
    if (p.at("name") == name) return p;
  }
  throw std::runtime_error("no " + name);
}

void expect_files(const Program& program, const std::string& folder) {
  for (const char* name : {"result.json", "trajectory.tum", "rig.yaml", "report.html"}) {
    EXPECT_TRUE(program.exists(folder + "/" + name)) << name;
  }
}

TEST(CliEstimate, MotionCaptureAndImu) {
  const Program program;
  make_mocap(program);
  const ProgramRun run = program.run("estimate imu.csv --poses mocap.csv --out out --gravity 9.81 --json");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json result = Json::parse(run.out);
  EXPECT_EQ(result.at("schema"), "vispline.result/1");
  EXPECT_TRUE(result.at("class") == "converged" || result.at("class") == "converged-weak") << result.at("class");
  const Json& clock = parameter(result, "reference0.time_offset");
  EXPECT_LT(std::abs(clock.at("value").at(0).get<double>()), 2e-3);
  EXPECT_GT(clock.at("sigma").at(0).get<double>(), 0.0);
  EXPECT_EQ(program.bytes("out/result.json"), run.out);
  expect_files(program, "out");
}

TEST(CliEstimate, CornersAndImu) {
  const Program program;
  ASSERT_EQ(program.run(kDance + "--rig euroc-stereo --scene aprilgrid --out d").exit, 0);
  const ProgramRun run = program.run(
      "calibrate d --rig d/rig.yaml --target d/target.yaml --corners cam0=d/corners_cam0.csv --corners "
      "cam1=d/corners_cam1.csv --out out --json "
      "--knot-spacing 0.06 --truth-rig d/rig.yaml");
  ASSERT_EQ(run.exit, 0) << run.err;
  const Json result = Json::parse(run.out);
  const Json& place = parameter(result, "cam0.T_c_i.translation");
  for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(place.at("error").at(i).get<double>()), 0.02) << i;
  expect_files(program, "out");
  EXPECT_TRUE(program.exists("out/d-camchain-imucam.yaml"));
}

TEST(CliEstimate, TracksAndImu) {
  const Program program;
  ASSERT_EQ(program
                .run("simulate --trajectory dance --duration 5 --seed 3 --rig phone --scene room --max-features 40 "
                     "--min-distance 40 --out d")
                .exit,
            0);
  const ProgramRun run = program.run("estimate d --rig d/rig.yaml --out out --json --knot-spacing 0.08");
  EXPECT_TRUE(run.exit == 0) << run.err;
  expect_files(program, "out");
  EXPECT_EQ(Json::parse(run.out).at("knots").at("spacing_s"), 0.08);
}

TEST(CliEstimate, WrongUnits) {
  const Program program;
  make_mocap(program);
  spoil(program, [](Time, ImuSample& s) { s.gyro *= 57.29577951; });
  expect_verdict(program, "E-UNITS", "deg/s");
  spoil(program, [](Time, ImuSample& s) { s.accel /= 9.80665; });
  expect_verdict(program, "E-UNITS", "looks like g");
}

TEST(CliEstimate, GravityRemoved) {
  const Program program;
  make_mocap(program);
  const Trajectory dance = analytic_trajectory("dance", Time{}, from_seconds(8.0)).value();
  spoil(program, [&](Time t, ImuSample& s) { s.accel -= 9.81 * dance.at(t)->R_w_b.transpose().col(2); });
  expect_verdict(program, "E-UNITS", "no gravity");
}

TEST(CliEstimate, WrongClock) {
  const Program program;
  make_mocap(program);
  const Trajectory other = analytic_trajectory("figure-eight", Time{}, from_seconds(20.0)).value();
  spoil(program, [&](Time t, ImuSample& s) { s.gyro = 3.0 * other.at(t)->omega_b; });
  expect_verdict(program, "E-CLOCK", "no offset");
}

TEST(CliEstimate, SwappedAxes) {
  const Program program;
  make_mocap(program);
  spoil(program, [](Time, ImuSample& s) { s.gyro.y() = -s.gyro.y(); });
  expect_verdict(program, "E-AXES", "gyroscope");
  spoil(program, [](Time, ImuSample& s) { std::swap(s.accel.x(), s.accel.z()); });
  expect_verdict(program, "E-AXES", "accelerometer");
}

TEST(CliEstimate, MissingExcitation) {
  const Program program;
  ASSERT_EQ(program
                .run("simulate --trajectory line --duration 8 --seed 3 --imu-rate 100 --noise course --out bad.csv "
                     "--truth mocap.csv")
                .exit,
            0);
  expect_verdict(program, "E-EXCITATION", "three axes");
}

/// Processor time of the only child of this process, s.
double child_cpu_s() {
  double seconds = 0.0;
  DIR* folder = ::opendir("/proc");
  while (const dirent* entry = ::readdir(folder)) {
    std::ifstream stat(std::string("/proc/") + entry->d_name + "/stat");
    std::string text;
    std::getline(stat, text);
    const std::size_t end = text.rfind(')');
    if (end == std::string::npos) continue;
    const std::vector<std::string> fields = words(text.substr(end + 1));
    if (fields.size() < 13 || std::stol(fields[1]) != ::getpid()) continue;
    seconds = (std::stod(fields[11]) + std::stod(fields[12])) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
  ::closedir(folder);
  return seconds;
}

TEST(CliEstimate, InterruptKeepsTheBestState) {
  const Program program;
  ASSERT_EQ(program.run("simulate --trajectory dance --duration 30 --seed 3 --rig phone --scene room --out d").exit, 0);
  RunOptions options{.signal = SIGINT};
  options.signal_when = [] { return child_cpu_s() > 1.0; };  // reading takes less, the iterations much more
  const ProgramRun run = program.run("estimate d --rig d/rig.yaml --out out --json --knot-spacing 0.05", options);
  EXPECT_EQ(run.exit, 130) << run.err;
  ASSERT_TRUE(program.exists("out/result.json")) << run.err;
  EXPECT_EQ(Json::parse(program.bytes("out/result.json")).at("class"), "stopped");
}

TEST(CliEstimate, NothingToEstimateFrom) {
  const Program program;
  make_mocap(program);
  const ProgramRun run = program.run("estimate imu.csv --out out");
  EXPECT_EQ(run.exit, 2);
  EXPECT_NE(run.err.find("neither poses nor tracks"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace vispline
