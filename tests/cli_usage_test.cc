// Wrong flags and values: exit 2, before anything is read or written.
#include "program.h"

namespace vispline {
namespace {

constexpr const char* kImu = "t,gx,gy,gz,ax,ay,az\n0.01,1,2,3,4,5,6\n0.02,1,2,4,4,5,6\n";
constexpr const char* kPoses = "0.01 1 2 3 0 0 0 1\n0.02 1 2 3 0 0 0 1\n";

void expect_usage(const Program& program, const std::string& arguments, const std::string& said) {
  SCOPED_TRACE(arguments);
  const auto before = program.files();
  const ProgramRun run = program.run(arguments);
  EXPECT_EQ(run.exit, 2);
  EXPECT_EQ(run.first_line().find("error[E-"), 0u) << run.err;
  EXPECT_NE(run.err.find(said), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("\n  effect: "), std::string::npos) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(program.files(), before);
}

TEST(CliUsage, Values) {
  const Program program;
  const std::string simulate = "simulate --trajectory dance --out a.csv ";
  for (const std::string bad : {"-1", "0", "nan", "inf", "1e300", "abc", "1e9x"}) {
    expect_usage(program, simulate + "--imu-rate " + bad, "--imu-rate: '" + bad + "' is not a number above 0");
    expect_usage(program, simulate + "--duration " + bad, "--duration: '" + bad + "' is not a number above 0");
    expect_usage(program, "integrate --trajectory dance --imu-rate 100," + bad,
                 "'" + bad + "' is not a number above 0");
    expect_usage(program, simulate + "--knot-spacing " + bad, "--knot-spacing");
  }
  for (const std::string bad : {"3", "7", "nan", "cubic"}) {
    expect_usage(program, simulate + "--order " + bad, "is not a number from 4 to 6");
  }
  for (const std::string flag : {"--gyro-white", "--accel-walk", "--seed", "--threads", "--imus"}) {
    for (const std::string bad : {"-1", "nan", "1e300", "x"}) expect_usage(program, simulate + flag + " " + bad, flag);
  }
  for (const std::string flag : {"--gravity", "--start", "--time-offset", "--quality", "--imu-position"}) {
    for (const std::string bad : {"nan", "1e300", "x"}) expect_usage(program, simulate + flag + " " + bad, flag);
  }
  expect_usage(program, simulate + "--imu-position 1,2", "--imu-position");
  expect_usage(program, simulate + "--seed 1.5", "--seed");
}

TEST(CliUsage, Names) {
  const Program program;
  program.write("imu.csv", kImu);
  const std::string simulate = "simulate --trajectory dance --out a.csv ";
  const std::string methods =
      "euler_course_2018, euler_course, euler, midpoint_course_report, midpoint_course_report_position_first";
  expect_usage(program, "integrate --trajectory ellipse --method foo", "no integration rule 'foo'");
  expect_usage(program, "integrate --trajectory ellipse --method midpoint,foo", "choose one of: " + methods);
  expect_usage(program, simulate + "--noise loud", "--noise");
  expect_usage(program, simulate + "--format foo", "--format");
  expect_usage(program, simulate + "--spline foo", "--spline");
  expect_usage(program, simulate + "--like imu.csv --decimal x", "--decimal");
  expect_usage(program, simulate + "--like imu.csv --time-unit h", "--time-unit");
  expect_usage(program, simulate + "--like imu.csv --input-format foo", "foo");
  expect_usage(program, simulate + "--like imu.csv --columns t,gx,gy,gz,ax,ay,foo", "foo");
  expect_usage(program, "evaluate imu.csv imu.csv --align foo", "--align");
  expect_usage(program, "evaluate imu.csv imu.csv --as foo", "--as");
  expect_usage(program, "frobnicate", "frobnicate");
  expect_usage(program, simulate + "--bogus", "--bogus");
  expect_usage(program, "simulate --trajectory dance", "--out");
  expect_usage(program, "simulate --out a.csv", "--trajectory");
  expect_usage(program, "evaluate imu.csv", "second");
}

TEST(CliUsage, FlagsThatDoNotGoTogether) {
  const Program program;
  const std::string simulate = "simulate --trajectory dance ";
  expect_usage(program, simulate + "--out a.csv --imus 2", "--format euroc");
  expect_usage(program, simulate + "--out a.csv --like imu.csv --imu-rate 100", "--imu-rate");
  expect_usage(program, simulate + "--out a --truth t.csv", "--format csv");
  expect_usage(program, "integrate --trajectory dance --method rk4,midpoint --out a.tum", "one --method");
  expect_usage(program, "integrate --trajectory dance --method rk4 --imu-rate 50,100 --out a.tum", "one --imu-rate");
}

TEST(CliUsage, UnknownTrajectoryListsTheNames) {
  const Program program;
  const ProgramRun run = program.run("simulate --trajectory danse --out a.csv");
  EXPECT_EQ(run.exit, 3);
  EXPECT_EQ(run.first_line(), "error[E-OPEN]: no trajectory 'danse'");
  EXPECT_NE(run.err.find("ellipse, static, line, figure-eight, dance"), std::string::npos);
  EXPECT_TRUE(program.files().empty());
}

TEST(CliUsage, KindsOfInput) {
  const Program program;
  program.write("imu.csv", kImu);
  program.write("poses.tum", kPoses);
  program.write("both.csv", "t,gx,gy,gz,ax,ay,az,qw,qx,qy,qz,px,py,pz\n1,1,2,3,4,5,6,1,0,0,0,1,2,3\n");
  expect_usage(program, "evaluate imu.csv poses.tum", "one file holds IMU samples, the other poses");
  expect_usage(program, "evaluate both.csv both.csv", "pass --as imu or --as trajectory");
  for (const std::string names : {"absent imu.csv", "imu.csv absent", "absent absent", "poses.tum absent"}) {
    const ProgramRun run = program.run("evaluate " + names);
    EXPECT_EQ(run.exit, 3) << names;
    EXPECT_EQ(run.first_line(), "error[E-OPEN]: cannot open 'absent': No such file or directory");
  }
}

TEST(CliUsage, VersionAndHelpAreResults) {
  const Program program;
  for (const std::string arguments : {"--version", "--help", "", "demo -h"}) {
    const ProgramRun run = program.run(arguments);
    EXPECT_EQ(run.exit, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_NE(run.out, "");
  }
}

}  // namespace
}  // namespace vispline
