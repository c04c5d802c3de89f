// vispline simulate --rig: the folder it fills is whole, reads back, and does not depend on threads.
#include "program.h"
#include "vispline/bags/open_bag.h"
#include "vispline/io/features.h"
#include "vispline/io/rig_file.h"

namespace vispline {
namespace {

const std::string kSimulate = "simulate --trajectory dance --duration 2 --seed 3 ";

bool holds(const std::vector<std::string>& files, const std::string& name) {
  return std::find(files.begin(), files.end(), name) != files.end();
}

TEST(CliRig, EveryPresetAndSceneReadsBack) {
  const Program program;
  for (const std::string rig : {"course", "euroc-stereo", "phone", "gopro"}) {
    for (const std::string scene : {"room", "cloud", "aprilgrid"}) {
      const std::string out = rig + "_" + scene;
      const ProgramRun run = program.run(kSimulate + "--rig " + rig + " --scene " + scene + " --out " + out);
      ASSERT_EQ(run.exit, 0) << run.err;
      EXPECT_EQ(run.err.find("warning"), std::string::npos) << run.err;
      const ReadRig read = read_rig({program.path(out + "/rig.yaml")});
      EXPECT_TRUE(read.diagnostics.empty());
      EXPECT_EQ(read_imu(program.path(out + "/mav0/imu0/data.csv")).counts.kept, 400);
      const std::string stem = scene == "aprilgrid" ? "/corners_" : "/tracks_";
      for (const Camera& camera : read.rig.cameras) {
        const auto features = read_features(program.path(out + stem + camera.name + ".csv"));
        EXPECT_NEAR(static_cast<double>(features.value.size()), 2.0 * camera.rate_hz, 1.0) << out;
        EXPECT_EQ(features.counts.read, features.counts.kept);
      }
    }
  }
}

TEST(CliRig, FilesOfOtherToolsAreTheRig) {
  const Program program;
  ASSERT_EQ(program.run(kSimulate + "--rig euroc-stereo --out a").exit, 0);
  const ReadRig truth = read_rig({program.path("a/rig.yaml")});
  const ReadRig kalibr = read_rig({program.path("a/kalibr/camchain.yaml"), program.path("a/kalibr/imu-chain.yaml")});
  ASSERT_EQ(kalibr.rig.cameras.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(kalibr.rig.cameras[i].lens.params, truth.rig.cameras[i].lens.params);
    EXPECT_LT((kalibr.rig.cameras[i].T_c_b.p - truth.rig.cameras[i].T_c_b.p).norm(), 1e-12);
  }
  const ProgramRun again =
      program.run(kSimulate + "--rig a/kalibr/camchain.yaml,a/kalibr/imu-chain.yaml --scene cloud --out b");
  EXPECT_EQ(again.exit, 0) << again.err;
}

TEST(CliRig, ThreadsChangeNothing) {
  const Program program;
  const std::string rig = kSimulate + "--rig phone --outliers 0.02 --dropout 0.1 --with mcap --out ";
  ASSERT_EQ(program.run(rig + "one --threads 1").exit, 0);
  ASSERT_EQ(program.run(rig + "many --threads 5").exit, 0);
  std::size_t compared = 0;
  for (const std::string& name : program.files()) {
    if (!name.starts_with("one/")) continue;
    EXPECT_EQ(program.bytes(name), program.bytes("many/" + name.substr(4))) << name;
    ++compared;
  }
  EXPECT_GE(compared, 12u);
}

TEST(CliRig, ImagesBagsAndCourseFiles) {
  const Program program;
  const ProgramRun run = program.run(
      "simulate --trajectory dance --duration 0.2 --rig euroc-stereo --scene checkerboard --images "
      "--with course,bag,rosbag2 --out a");
  ASSERT_EQ(run.exit, 0) << run.err;
  const auto files = program.files();
  for (const char* name :
       {"a/mav0/cam0/data/10000000.png", "a/mav0/cam1/data/160000000.png", "a/mav0/cam1/data.csv", "a/target.yaml",
        "a/target_points.csv", "a/course/keyframe/all_points_3.txt", "a/course/README.txt", "a/recording.bag"}) {
    EXPECT_TRUE(holds(files, name)) << name;
  }
  for (const char* name : {"a/recording.bag", "a/rosbag2"}) {
    std::map<std::string, std::int64_t> counts;
    const auto bag = open_bag(program.path(name));
    for (const Topic& topic : bag->topics()) counts[topic.name] = topic.count.value_or(-1);
    EXPECT_EQ(counts["/imu0"], 40) << name;
    EXPECT_EQ(counts["/cam1/image_raw"], 4) << name;
    EXPECT_EQ(counts["/ground_truth/pose"], 40) << name;
  }
}

TEST(CliRig, WhatIsRefused) {
  const Program program;
  const auto code = [&](const std::string& arguments, int exit) {
    const ProgramRun run = program.run("simulate --trajectory dance " + arguments + " --out a");
    EXPECT_EQ(run.exit, exit) << run.err;
    return run.first_line().substr(0, run.first_line().find(':'));
  };
  EXPECT_EQ(code("--rig none.yaml", 3), "error[E-OPEN]");
  EXPECT_EQ(code("--rig phone --scene nothing.csv", 3), "error[E-OPEN]");
  EXPECT_EQ(code("--rig phone --noise course", 2), "error[E-ARGUMENT]");
  EXPECT_EQ(code("--rig phone --with course", 2), "error[E-ARGUMENT]");
  EXPECT_EQ(code("--rig phone --scene cloud --images", 2), "error[E-ARGUMENT]");
  EXPECT_EQ(code("--scene room", 2), "error[E-USAGE]");
  EXPECT_TRUE(program.files().empty());
}

}  // namespace
}  // namespace vispline
