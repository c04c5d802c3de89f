// Outputs, interrupts, threads, locale: what the program leaves when the machine or the user gets in the way.
#include <csignal>

#include "program.h"
#include "vispline/files/input_file.h"

namespace vispline {
namespace {

constexpr int kOutput = 6;

void expect_error(const ProgramRun& run, int exit, const std::string& code) {
  EXPECT_EQ(run.exit, exit) << run.err;
  EXPECT_EQ(run.first_line().find("error[" + code + "]: "), 0u) << run.err;
  EXPECT_EQ(run.out, "");
}

TEST(CliOutput, KeepsWhatExists) {
  const Program program;
  program.write("a.csv", "old");
  const std::string simulate = "simulate --trajectory dance --duration 1 --out ";
  expect_error(program.run(simulate + "a.csv"), kOutput, "E-OUTPUT");
  expect_error(program.run(simulate + "b.csv --truth a.csv"), kOutput, "E-OUTPUT");
  expect_error(program.run("integrate --trajectory dance --method rk4 --out a.csv"), kOutput, "E-OUTPUT");
  EXPECT_EQ(program.bytes("a.csv"), "old");
  EXPECT_EQ(program.files(), std::vector<std::string>{"a.csv"});
  EXPECT_EQ(program.run(simulate + "a.csv -f").exit, 0);
  EXPECT_EQ(lines(program.bytes("a.csv")).size(), 201u);
  EXPECT_EQ(program.files(), std::vector<std::string>{"a.csv"});
}

TEST(CliOutput, OldResultSurvivesAFailedRun) {
  const Program program;
  program.write("a.csv", "old");
  program.write("bad.csv", "t,gx,gy,gz,ax,ay,az\n");
  expect_error(program.run("simulate --trajectory dance --like bad.csv --out a.csv --force"), 3, "E-EMPTY");
  EXPECT_EQ(program.bytes("a.csv"), "old");
  EXPECT_EQ(program.files().size(), 2u);
}

TEST(CliOutput, AllFilesOfASetAreProbedFirst) {
  const Program program;
  std::filesystem::create_directories(program.path("set/mav0/imu2"));
  program.write("set/mav0/imu2/data.csv", "old");
  expect_error(program.run("simulate --trajectory dance --imus 3 --out set"), kOutput, "E-OUTPUT");
  EXPECT_EQ(program.files(), std::vector<std::string>{"set/mav0/imu2/data.csv"});
  expect_error(program.run("simulate --trajectory dance --out a.csv --truth ./a.csv -f"), 2, "E-ARGUMENT");
}

TEST(CliOutput, PlacesThatCannotBeWritten) {
  const Program program;
  program.write("file", "");
  for (const std::string out : {"/dev/full", "/dev/full/a.csv", "file/a.csv", "a.csv/"}) {
    expect_error(program.run("simulate --trajectory dance --format csv --out " + out), kOutput, "E-OUTPUT");
  }
  expect_error(program.run({"simulate", "--trajectory", "dance", "--out", ""}), 2, "E-USAGE");
  expect_error(program.run({"demo", "--out", ""}), 2, "E-USAGE");
  EXPECT_EQ(program.files(), std::vector<std::string>{"file"});
}

TEST(CliOutput, ReadOnlyFolder) {
  const Program program;
  std::filesystem::create_directory(program.path("locked"));
  std::filesystem::permissions(program.path("locked"), std::filesystem::perms(0500));
  if (::access(program.path("locked").c_str(), W_OK) == 0) GTEST_SKIP() << "this user may write everywhere";
  expect_error(program.run("simulate --trajectory dance --out locked/a.csv"), kOutput, "E-OUTPUT");
}

TEST(CliOutput, FullDiskBehindStdout) {
  const Program program;
  const ProgramRun run = program.run("integrate --trajectory ellipse --json", {.stdout_path = "/dev/full"});
  expect_error(run, kOutput, "E-OUTPUT");
}

TEST(CliOutput, AskedForMoreThanTheMachineHas) {
  const Program program;
  expect_error(program.run("simulate --trajectory static --duration 1e9 --imu-rate 1e6 --out a.csv"), kOutput,
               "E-OUTPUT");
  expect_error(program.run("integrate --trajectory static --duration 1e9 --imu-rate 1e8 --method rk4"), 7, "E-LIMIT");
  EXPECT_TRUE(program.files().empty());
}

TEST(CliOutput, CompressedByName) {
  const Program program;
  ASSERT_EQ(program.run("simulate --trajectory dance --duration 1 --out a.csv").exit, 0);
  ASSERT_EQ(program.run("simulate --trajectory dance --duration 1 --out a.csv.xz").exit, 0);
  EXPECT_EQ(program.bytes("a.csv.xz").substr(1, 4), "7zXZ");
  EXPECT_EQ(read_text_file(program.path("a.csv.xz")), program.bytes("a.csv"));
}

TEST(CliInterrupt, LeavesNothingInTheMiddleOfADay) {
  const Program program;
  for (const int signal : {SIGINT, SIGTERM}) {
    RunOptions options{.signal = signal};
    options.signal_when = [&] { return program.bytes_in_the_making() > 10'000'000; };  // well after the first block
    const ProgramRun run = program.run(
        "simulate --trajectory dance --duration 86400 --imu-rate 200 --noise course --out day.csv", options);
    expect_error(run, 128 + signal, "E-INTERRUPTED");
    EXPECT_LT(run.stop_s, 2.0);
    EXPECT_TRUE(program.files().empty()) << program.files()[0];
  }
}

TEST(CliInterrupt, EndsWorkThatDoesNotPoll) {
  const Program program;
  const auto begin = std::chrono::steady_clock::now();
  RunOptions options{.signal = SIGINT};
  options.signal_when = [&] { return std::chrono::steady_clock::now() - begin > std::chrono::seconds(1); };
  const ProgramRun run =
      program.run("integrate --trajectory ellipse --duration 18000 --imu-rate 200 --method all", options);
  expect_error(run, 130, "E-INTERRUPTED");
  EXPECT_LT(run.stop_s, 2.0);
}

TEST(CliDeterminism, ThreadsAndLocaleChangeNoByte) {
  const Program program;
  const std::string common =
      "simulate --trajectory dance --duration 300 --noise course --gyro-bias-instability 1e-4 --accel-turn-on-bias "
      "0.01 "
      "--seed 77 --truth t.csv --force --json --out ";
  const ProgramRun one = program.run(common + "a.csv --threads 1");
  ASSERT_EQ(one.exit, 0) << one.err;
  const std::string imu = program.bytes("a.csv"), truth = program.bytes("t.csv");
  ASSERT_EQ(lines(imu).size(), 60'001u);
  for (const std::string threads : {"2", "4"}) {
    EXPECT_EQ(program.run(common + "a.csv --threads " + threads).out, one.out);
    EXPECT_TRUE(program.bytes("a.csv") == imu) << threads;
    EXPECT_TRUE(program.bytes("t.csv") == truth) << threads;
  }
  for (const std::string locale : {"de_DE.UTF-8", "C", "tr_TR.UTF-8"}) {
    const RunOptions options{
        .environment = {{"LANG", locale}, {"LC_ALL", locale}, {"NO_COLOR", "1"}, {"TZ", "Asia/Tokyo"}}};
    EXPECT_EQ(program.run(common + "a.csv", options).out, one.out);
    EXPECT_TRUE(program.bytes("a.csv") == imu) << locale;
    EXPECT_EQ(program.run("integrate --trajectory ellipse", options).out,
              program.run("integrate --trajectory ellipse").out);
  }
  EXPECT_EQ(program.run("simulate --trajectory dance --duration 300 --noise course --seed 78 --out b.csv").exit, 0);
  EXPECT_FALSE(program.bytes("b.csv") == imu);
}

TEST(CliDeterminism, InputsAreNotChanged) {
  const Program program;
  ASSERT_EQ(program.run("simulate --trajectory dance --out a.csv --truth t.csv").exit, 0);
  const std::string a = program.bytes("a.csv"), t = program.bytes("t.csv");
  ASSERT_EQ(program.run("simulate --trajectory t.csv --like a.csv --out b.csv").exit, 0);
  ASSERT_EQ(program.run("evaluate a.csv b.csv").exit, 0);
  EXPECT_EQ(program.bytes("a.csv"), a);
  EXPECT_EQ(program.bytes("t.csv"), t);
  EXPECT_EQ(program.files().size(), 3u);
}

}  // namespace
}  // namespace vispline
