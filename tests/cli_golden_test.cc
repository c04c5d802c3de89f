// What the program prints, for people and for programs, against tests/golden.
#include "cli_inputs.h"
#include "golden.h"

namespace vispline {
namespace {

/// An order near the level of rounding is a quotient of two rounding errors.
const GoldenTolerance kOrders{.by_word = {{"order", 0.02}}};

void expect_printed(const Program& program, const std::string& arguments, const std::string& golden,
                    const GoldenTolerance& tolerance = {}) {
  SCOPED_TRACE(arguments);
  const ProgramRun run = program.run(arguments);
  EXPECT_EQ(run.exit, 0) << run.err;
  expect_golden(golden, run.out, tolerance);
}

TEST(CliGolden, Help) {
  const Program program;
  expect_printed(program, "--help", "help.txt");
  expect_printed(program, "", "help.txt");
  for (const std::string verb : {"simulate", "integrate", "evaluate", "demo"}) {
    expect_printed(program, verb + " --help", "help_" + verb + ".txt");
  }
}

TEST(CliGolden, Integrate) {
  const Program program;
  const std::string command =
      "integrate --trajectory ellipse --duration 20 --imu-rate 50,100,200,400,1000 --method all";
  expect_printed(program, command, "integrate.txt", kOrders);
  expect_printed(program, command + " --json", "integrate.json", kOrders);
}

TEST(CliGolden, EvaluateImu) {
  const Program program;
  make_imu_pair(program);
  expect_printed(program, "evaluate first.csv second.csv", "evaluate_imu.txt");
  expect_printed(program, "evaluate first.csv second.csv --json", "evaluate_imu.json");
}

TEST(CliGolden, EvaluateTrajectory) {
  const Program program;
  make_trajectory_pair(program);
  expect_printed(program, "evaluate estimate.tum truth.csv", "evaluate_trajectory.txt");
  expect_printed(program, "evaluate estimate.tum truth.csv --align se3 --json", "evaluate_trajectory.json");
  expect_printed(program, "evaluate estimate.tum truth.csv --align sim3", "evaluate_trajectory_sim3.txt");
}

TEST(CliGolden, Simulate) {
  const Program program;
  make_trajectory_pair(program);
  expect_printed(program, "simulate --trajectory dance --duration 7 --seed 5 --out a.csv --json", "simulate.json");
  expect_printed(program, "simulate --trajectory dance --duration 7 --format euroc --out a", "simulate.txt");
  const std::string fitted = "simulate --trajectory estimate.tum --knot-spacing 0.05 --like imu.csv --out ";
  expect_printed(program, fitted + "b.csv --json", "simulate_fit.json");
  expect_printed(program, fitted + "c.csv", "simulate_fit.txt");
}

}  // namespace
}  // namespace vispline
