// The commands of the manual, as they are written there, and what each of them leaves behind.
#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli_inputs.h"
#include "vispline/core/so3.h"
#include "vispline/results/imu_comparison.h"

namespace vispline {
namespace {

using nlohmann::json;

void expect_done(const ProgramRun& run) { EXPECT_EQ(run.exit, 0) << run.err; }

/// Cells of a text table; all rows must have the same number.
std::vector<std::vector<double>> table(const std::string& bytes) {
  std::vector<std::vector<double>> rows;
  for (const std::string& line : lines(bytes)) {
    rows.emplace_back();
    for (const std::string& cell : words(line)) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
    EXPECT_EQ(rows.back().size(), rows.front().size()) << "row " << rows.size();
  }
  return rows;
}

std::array<std::size_t, 2> shape(const std::string& bytes) {
  const auto rows = table(bytes);
  return {rows.size(), rows.empty() ? 0 : rows[0].size()};
}

/// The course's ellipse by its own formulas: Euler angles, their rates by E(euler), specific force.
std::array<double, 13> course_ellipse(double t) {
  const double K = std::numbers::pi / 10.0, roll = 0.1 * std::cos(t), pitch = 0.2 * std::sin(t), yaw = K * t;
  const Eigen::Quaterniond q = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
                               Eigen::AngleAxisd(roll, Vector3d::UnitX());
  const Vector3d p(15 * std::cos(K * t) + 5, 20 * std::sin(K * t) + 5, std::sin(10 * K * t) + 5);
  const Vector3d a(-15 * K * K * std::cos(K * t), -20 * K * K * std::sin(K * t), -100 * K * K * std::sin(10 * K * t));
  const Vector3d rates(-0.1 * std::sin(t), 0.2 * std::cos(t), K);
  Matrix3d E;
  E << 1, 0, -std::sin(pitch), 0, std::cos(roll), std::sin(roll) * std::cos(pitch), 0, -std::sin(roll),
      std::cos(roll) * std::cos(pitch);
  const Vector3d w = E * rates, f = q.conjugate() * (a + Vector3d(0, 0, 9.81));
  return {q.w(), q.x(), q.y(), q.z(), p.x(), p.y(), p.z(), w.x(), w.y(), w.z(), f.x(), f.y(), f.z()};
}

/// q and -q are one attitude.
void expect_row(const std::vector<double>& row, std::array<double, 13> wanted) {
  const double sign = row[1] * wanted[0] + row[2] * wanted[1] + row[3] * wanted[2] + row[4] * wanted[3] < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 4; ++i) wanted[i] *= sign;
  for (std::size_t i = 0; i < 13; ++i) EXPECT_NEAR(row[i + 1], wanted[i], 1e-12) << "t = " << row[0] << ", cell " << i;
}

TEST(CliCommands, CourseFolder) {
  const Program program;
  expect_done(
      program.run("simulate --trajectory ellipse --duration 20 --imu-rate 200 --noise none --format course "
                  "--out out/course"));
  const auto bytes = [&](const std::string& name) { return program.bytes("out/course/" + name); };
  using Shape = std::array<std::size_t, 2>;
  EXPECT_EQ(shape(bytes("imu_pose.txt")), (Shape{4000, 14}));
  EXPECT_EQ(shape(bytes("imu_pose_noise.txt")), (Shape{4000, 14}));
  EXPECT_EQ(shape(bytes("imu_int_pose.txt")), (Shape{3999, 15}));
  EXPECT_EQ(shape(bytes("imu_int_pose_noise.txt")), (Shape{3999, 15}));
  EXPECT_EQ(shape(bytes("cam_pose.txt")), (Shape{600, 14}));
  EXPECT_EQ(shape(bytes("cam_pose_tum.txt")), (Shape{600, 8}));
  EXPECT_EQ(shape(bytes("all_points.txt")), (Shape{36, 4}));
  EXPECT_EQ(shape(bytes("velocity.txt")), (Shape{4000, 4}));
  EXPECT_EQ(shape(bytes("bias.txt")), (Shape{4000, 7}));
  EXPECT_EQ(program.files().size(), 10u + 600u + 600u);
  EXPECT_TRUE(program.exists("out/course/keyframe/all_points_599.txt"));
  EXPECT_TRUE(program.exists("out/course/keyframe/all_lines_599.txt"));
}

TEST(CliCommands, CourseRowsAreTheFormulas) {
  const Program program;
  expect_done(program.run("simulate --trajectory ellipse --duration 2 --format course --out c"));
  const auto imu = table(program.bytes("c/imu_pose.txt"));
  for (std::size_t i = 0; i < imu.size(); i += 37) {
    EXPECT_EQ(imu[i][0], static_cast<double>(5 * i) / 1000.0);
    expect_row(imu[i], course_ellipse(imu[i][0]));
  }
  const auto camera = table(program.bytes("c/cam_pose.txt"));
  ASSERT_EQ(camera.size(), 60u);
  Matrix3d R_b_c;
  R_b_c << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  for (std::size_t i = 0; i < camera.size(); i += 7) {
    auto wanted = course_ellipse(camera[i][0]);
    const Eigen::Quaterniond q_w_b(wanted[0], wanted[1], wanted[2], wanted[3]), q_w_c(q_w_b * R_b_c);
    const Vector3d p = Vector3d(wanted[4], wanted[5], wanted[6]) + q_w_b * Vector3d(0.05, 0.04, 0.03);
    const std::array<double, 7> pose{q_w_c.w(), q_w_c.x(), q_w_c.y(), q_w_c.z(), p.x(), p.y(), p.z()};
    std::copy(pose.begin(), pose.end(), wanted.begin());
    EXPECT_NEAR(camera[i][0], static_cast<double>(i) / 30.0, 1e-9);
    expect_row(camera[i], wanted);
  }
}

TEST(CliCommands, LikeARecordedImu) {
  const Program program;
  make_trajectory_pair(program);
  expect_done(program.run("simulate --trajectory truth.csv --like imu.csv --noise none --out synth.csv"));
  const ImuSignal synth = read_imu(program.path("synth.csv")).value, imu = read_imu(program.path("imu.csv")).value;
  EXPECT_TRUE(synth.time == imu.time) << synth.size() << " of " << imu.size();
  const ImuComparison same = compare_imu(synth, imu);
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(same.accelerometer[static_cast<std::size_t>(axis)].rms, 5e-3);
  expect_done(program.run("evaluate synth.csv imu.csv --json"));
}

TEST(CliCommands, StaticWithNoise) {
  const Program program;
  expect_done(
      program.run("simulate --trajectory static --duration 600 --imu-rate 200 --gyro-white 0.01 --gyro-walk 5e-5 "
                  "--accel-white 0.01 "
                  "--accel-walk 5e-5 --seed 1 --out static.csv"));
  const auto rows = lines(program.bytes("static.csv"));
  ASSERT_EQ(rows.size(), 1u + 120'000u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].substr(0, rows[i].find(',')), std::to_string(5'000'000 * (i - 1)));
  }
  const ImuSignal imu = read_imu(program.path("static.csv")).value;
  Vector3d mean = Vector3d::Zero(), gyro_square = Vector3d::Zero();
  for (const ImuSample& sample : imu.value) {
    mean += sample.accel / 120'000.0;
    gyro_square += sample.gyro.cwiseAbs2() / 120'000.0;
  }
  EXPECT_NEAR((mean - Vector3d(0, 0, 9.81)).norm(), 0.0, 0.01) << "walk of 5e-5 sqrt(600 / 3) = 7e-4 and white noise";
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(gyro_square(axis)), 0.01 * std::sqrt(200.0), 5e-3) << "sigma of the reading: N sqrt(rate)";
  }
}

TEST(CliCommands, StampsDoNotDriftAtAnOddRate) {
  const Program program;
  expect_done(program.run("simulate --trajectory static --duration 86400 --imu-rate 1.1 --noise course --out day.csv"));
  const auto rows = lines(program.bytes("day.csv"));
  ASSERT_EQ(rows.size(), 1u + 95'040u);
  for (std::size_t i = 0; i + 1 < rows.size(); i += 11) {
    ASSERT_EQ(rows[i + 1].substr(0, rows[i + 1].find(',')), std::to_string(10'000'000'000ULL * (i / 11)));
  }
}

TEST(CliCommands, IntegrationTable) {
  const Program program;
  const ProgramRun run =
      program.run("integrate --trajectory ellipse --duration 20 --imu-rate 50,100,200,400,1000 --method all --json");
  expect_done(run);
  struct Wanted {
    const char* method;
    double final_error_m, tolerance, order;
  };
  std::map<std::string, json> rows;
  const json table = json::parse(run.out);
  for (const json& row : table["rows"]) {
    if (row["rate_hz"] == 200.0) rows[row["method"]] = row;
  }
  for (const Wanted& wanted :
       {Wanted{"euler_course_2018", 0.5766, 5e-5, 1}, Wanted{"euler_course", 1.0423, 5e-5, 1},
        Wanted{"euler", 0.9062, 5e-5, 1}, Wanted{"midpoint_course_report", 0.4688, 5e-5, 1},
        Wanted{"midpoint", 1.286e-3, 5e-7, 2}, Wanted{"rk4", 1.253e-3, 5e-7, 2}, Wanted{"rk4_cubic", 0.0, 1e-5, 4}}) {
    const json& row = rows.at(wanted.method);
    EXPECT_NEAR(row["final_error_m"].get<double>(), wanted.final_error_m, wanted.tolerance) << wanted.method;
    EXPECT_NEAR(row["order"].get<double>(), wanted.order, 0.05) << wanted.method;
  }
}

TEST(CliCommands, Evaluate) {
  const Program program;
  make_imu_pair(program);
  make_trajectory_pair(program);
  const ProgramRun imu = program.run("evaluate first.csv second.csv --json");
  const ProgramRun trajectory = program.run("evaluate estimate.tum truth.csv --align se3 --json");
  expect_done(imu);
  expect_done(trajectory);
  EXPECT_EQ(json::parse(imu.out)["schema"], "vispline.evaluate_imu/1");
  EXPECT_EQ(json::parse(trajectory.out)["schema"], "vispline.evaluate_trajectory/1");
  expect_done(program.run("evaluate first.csv first.csv --strict"));
  expect_done(program.run("evaluate truth.csv truth.csv --strict"));
  const double ate_m = json::parse(trajectory.out)["ate"]["rmse_m"];
  EXPECT_GT(ate_m, 1e-3) << "the errors put into the estimate are of 2 cm";
  EXPECT_LT(ate_m, 2e-2);
}

TEST(CliCommands, Demo) {
  const Program program;
  expect_done(program.run("demo --out DIR"));
  EXPECT_EQ(program.files(), (std::vector<std::string>{"DIR/imu.csv", "DIR/integration.json", "DIR/report.html",
                                                       "DIR/result.json", "DIR/truth.tum"}));
  EXPECT_EQ(json::parse(program.bytes("DIR/result.json"))["class"], "converged");
  EXPECT_TRUE(program.bytes("DIR/report.html").starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(read_imu(program.path("DIR/imu.csv")).value.size(), 4001u);
  const std::string report = program.bytes("DIR/report.html");
  expect_done(program.run("demo --out DIR"));
  EXPECT_EQ(program.bytes("DIR/report.html"), report) << "same seed, same bytes";
}

TEST(CliCommands, IntegrateWritesItsTrajectory) {
  const Program program;
  expect_done(program.run("integrate --trajectory dance --duration 5 --method rk4_cubic --out estimate.tum"));
  expect_done(program.run("simulate --trajectory dance --duration 5.005 --out imu.csv --truth truth.csv"));
  const ProgramRun run = program.run("evaluate estimate.tum truth.csv --align none --json");
  expect_done(run);
  EXPECT_LT(json::parse(run.out)["ate"]["max_m"].get<double>(), 1e-5);
}

}  // namespace
}  // namespace vispline
