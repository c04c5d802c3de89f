#include "vispline/io/sensor_folder.h"

#include <filesystem>

#include "vispline/io/io_testing.h"
#include "vispline/io/write.h"

namespace vispline {
namespace {

class EurocFolder : public ::testing::Test {
 protected:
  std::string sensor(const std::string& name) const {
    std::filesystem::create_directories(folder_.path("mav0/" + name));
    return folder_.path("mav0/" + name + "/data.csv");
  }
  void add_imu(const std::string& name, std::size_t rows) const { write_imu_csv(sensor(name), random_imu(rows, 1)); }
  void add_poses(const std::string& name, std::size_t rows) const {
    write_trajectory_euroc(sensor(name), random_poses(rows, 1));
  }
  std::string root() const { return folder_.path("."); }

  ScratchFolder folder_;
};

TEST_F(EurocFolder, SensorsAreFoundByTheirNames) {
  add_imu("imu0", 100);
  add_poses("mocap0", 80);
  std::filesystem::create_directories(folder_.path("mav0/cam0/data"));
  for (const std::string& path : {root(), folder_.path("mav0")}) {
    EXPECT_EQ(imu_outcome(path).kept, 100);
    EXPECT_EQ(trajectory_outcome(path).kept, 80);
    EXPECT_EQ(imu_outcome(path, {.topic = "imu0"}).kept, 100);
  }
  EXPECT_EQ(imu_outcome(folder_.path("mav0/imu0")).kept, 100);
  EXPECT_EQ(content_of(root()), ContentKind::kImu);
  EXPECT_EQ(content_of(root(), {.topic = "mocap0"}), ContentKind::kTrajectory);
}

TEST_F(EurocFolder, SeveralAreAmbiguousAndAbsentOnesListed) {
  add_imu("imu0", 100);
  add_imu("imu1", 110);
  EXPECT_EQ(imu_outcome(root()).codes, "E-TOPIC-AMBIGUOUS");
  EXPECT_EQ(imu_outcome(root(), {.topic = "imu1"}).kept, 110);
  const Outcome absent = imu_outcome(root(), {.topic = "imu2"});
  EXPECT_EQ(absent.codes, "E-TOPIC");
  EXPECT_EQ(absent.next, "pass --topic with one of 'imu0', 'imu1'");
  EXPECT_EQ(trajectory_outcome(root()).codes, "E-TOPIC");
  EXPECT_EQ(imu_outcome(root(), {.topic = "../mav0/imu0"}).codes, "E-TOPIC");
}

TEST_F(EurocFolder, OfKalibrsBagExtractor) {
  write_imu_csv(folder_.path("imu0.csv"), random_imu(70, 1));
  std::filesystem::create_directories(folder_.path("cam0"));
  EXPECT_EQ(imu_outcome(folder_.path(".")).kept, 70);
}

TEST_F(EurocFolder, AnotherFolderIsNoRecording) {
  EXPECT_EQ(imu_outcome(root()).codes, "E-OPEN");
  EXPECT_EQ(trajectory_outcome(root()).codes, "E-OPEN");
}

}  // namespace
}  // namespace vispline
