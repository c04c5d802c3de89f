// info and convert as a user runs them: recordings, folders and tables into each other, and what is said about them.
#include <csignal>

#include "program.h"
#include "vispline/io/write.h"

namespace vispline {
namespace {

/// A folder as Kalibr's bag extractor leaves it: imu0.csv and mocap0.csv, 1 min.
void make_folder(const Program& program) {
  std::filesystem::create_directories(program.path("walk"));
  write_imu_csv(program.path("walk/imu0.csv"), random_imu(12'000, 3));
  write_trajectory_euroc(program.path("walk/mocap0.csv"), random_poses(7'000, 4));
}

void expect_done(const ProgramRun& run) { EXPECT_EQ(run.exit, 0) << run.err; }

TEST(CliConvert, RoundTheHouseWithoutLosingABit) {
  const Program program;
  make_folder(program);
  const std::string steps[] = {"convert walk a.bag --compression bz2",   "convert a.bag b.mcap --compression zstd",
                               "convert b.mcap c --format rosbag2",      "convert c d.bag --compression lz4",
                               "convert d.bag e --format euroc",         "convert e f.mcap --compression lz4",
                               "convert f.mcap imu.csv --as imu",        "convert f.mcap poses.csv --as trajectory",
                               "convert f.mcap poses.tum --topic /pose", "convert f.mcap imu.gcsv"};
  for (const std::string& step : steps) expect_done(program.run(step));
  EXPECT_EQ(program.bytes("imu.csv"), program.bytes("walk/imu0.csv"));
  EXPECT_EQ(program.bytes("e/mav0/imu0/data.csv"), program.bytes("walk/imu0.csv"));
  EXPECT_EQ(lines(program.bytes("poses.csv")).size(), 7001u);
  EXPECT_EQ(lines(program.bytes("poses.tum")).size(), 7000u);
  expect_done(program.run("evaluate poses.tum walk --as trajectory --topic auto --topic mocap0"));
}

TEST(CliConvert, SaysWhatItNeeds) {
  const Program program;
  make_folder(program);
  EXPECT_EQ(program.run("convert walk out.unknown").exit, 2);
  EXPECT_EQ(program.run("convert walk out.csv").exit, 2) << "IMU samples and poses";
  EXPECT_EQ(program.run("convert absent.bag out.csv").exit, 3);
  expect_done(program.run("convert walk a.bag"));
  const ProgramRun again = program.run("convert walk a.bag");
  EXPECT_EQ(again.exit, 6);
  EXPECT_NE(again.err.find("error[E-OUTPUT]"), std::string::npos);
  const ProgramRun topic = program.run("convert a.bag b.csv --topic /imu1");
  EXPECT_EQ(topic.exit, 4);
  EXPECT_NE(topic.err.find("error[E-TOPIC]"), std::string::npos) << topic.err;
  EXPECT_FALSE(program.exists("b.csv"));
}

TEST(CliConvert, AnInterruptLeavesNothing) {
  const Program program;
  expect_done(
      program.run("simulate --trajectory dance --start 1600000000 --duration 1800 --noise course --out imu.csv"));
  for (const int signal : {SIGINT, SIGTERM}) {
    RunOptions options{.signal = signal};
    options.signal_when = [&] { return program.bytes_in_the_making() > 500'000; };
    const ProgramRun run = program.run("convert imu.csv imu.bag --compression bz2", options);
    EXPECT_EQ(run.exit, 128 + signal) << run.err;
    EXPECT_LT(run.stop_s, 2.0);
    EXPECT_EQ(program.files(), std::vector<std::string>{"imu.csv"});
  }
}

TEST(CliInfo, OfEveryKindOfFile) {
  const Program program;
  make_folder(program);
  expect_done(program.run("convert walk a.bag"));
  for (const std::string file : {"a.bag", "walk", "walk/imu0.csv", "walk/mocap0.csv"}) {
    const ProgramRun run = program.run("info " + file);
    expect_done(run);
    EXPECT_NE(run.out.find("Hz, median step"), std::string::npos) << run.out;
  }
  const ProgramRun bag = program.run("info a.bag");
  EXPECT_NE(bag.out.find("'/imu0'"), std::string::npos);
  EXPECT_NE(bag.out.find("12000 read, 12000 kept, 0 dropped"), std::string::npos) << bag.out;
  EXPECT_NE(bag.err.find("samples: 19000 read, 19000 kept, 0 dropped"), std::string::npos) << bag.err;
  EXPECT_EQ(program.run("info a.bag --topic /absent").exit, 4);
  EXPECT_EQ(program.run("info absent").exit, 3);
}

TEST(CliInfo, OfACutRecording) {
  const Program program;
  make_folder(program);
  expect_done(program.run("convert walk a.bag"));
  const std::string whole = program.bytes("a.bag");
  program.write("cut.bag", whole.substr(0, whole.size() / 2));
  const ProgramRun run = program.run("info cut.bag");
  expect_done(run);
  EXPECT_NE(run.err.find("warning[W-TRUNCATED]"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("without a good index"), std::string::npos) << run.out;
}

TEST(CliInfo, OfParameterFiles) {
  const Program program;
  program.write("imu.yaml",
                "accelerometer_noise_density: 0.01\naccelerometer_random_walk: 0.0002\ngyroscope_noise_density: 0.001\n"
                "gyroscope_random_walk: 2.0e-05\nrostopic: /imu0\nupdate_rate: 200.0\n");
  const ProgramRun good = program.run("info imu.yaml");
  expect_done(good);
  EXPECT_NE(good.out.find("gyro N 0.001 rad/s/sqrt(Hz)"), std::string::npos) << good.out;
  program.write("bad.yaml", "gyroscope_noise_density: 0.001\ngyroscope_random_walk: nothing\n");
  EXPECT_EQ(program.run("info bad.yaml").exit, 2);
  program.write("target.yaml", "target_type: 'aprilgrid'\ntagCols: 6\ntagRows: 6\ntagSize: 0.088\ntagSpacing: 0.3\n");
  const ProgramRun target = program.run("info target.yaml");
  EXPECT_NE(target.out.find("6 x 6 tags of 0.088 m"), std::string::npos) << target.out << target.err;
}

}  // namespace
}  // namespace vispline
