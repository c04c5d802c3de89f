/// Poses: quaternions, lost markers, order of columns; and what a file holds.
#include "vispline/io/read.h"

#include "vispline/io/read_testing.h"
#include "vispline/io/tum.h"

namespace vispline {
namespace {

std::string tum_text(const std::function<void(Signal<Pose>&)>& edit = [](auto&) {}) {
  Signal<Pose> poses = random_poses(500, 21);
  edit(poses);
  return tum::text(poses);
}

TEST(ReadTrajectory, Quaternions) {  // row 58
  const ScratchFolder folder;
  const auto outcome_with = [&](const std::string& last_row, const ReadOptions& options = {}) {
    return trajectory_outcome(folder.write("f", tum_text() + "1520530312.356179851 1 2 3 " + last_row + "\n"), options);
  };
  EXPECT_EQ(outcome_with("0.5 -0.5 0.5 0.5004").codes, "");
  EXPECT_EQ(outcome_with("0.5 -0.5 0.5 0.51").codes, "W-QUATERNION");
  EXPECT_EQ(outcome_with("0.5 -0.5 0.5 0.51").kept, 501);
  EXPECT_EQ(outcome_with("0.5 -0.5 0.5 0.9").codes, "E-QUATERNION");
  EXPECT_EQ(outcome_with("0.5 -0.5 0.5 0.9").exit, 3);
  EXPECT_EQ(outcome_with("0 0 0 0", {.repair = true}).kept, 500);
  EXPECT_EQ(outcome_with("nan 0 0 0").codes, "W-NONFINITE");
  EXPECT_EQ(outcome_with("nan 0 0 0").kept, 500);
}

TEST(ReadTrajectory, LostPosesAreGapsUpToHalf) {
  const ScratchFolder folder;
  const auto lost = [&](std::size_t every) {
    return trajectory_outcome(folder.write("f", tum_text([=](Signal<Pose>& poses) {
                                             for (std::size_t i = 0; i < poses.size(); ++i)
                                               if (i % 10 < every) poses.value[i].p.x() = NAN;
                                           })));
  };
  EXPECT_EQ(lost(2).kept, 400);
  EXPECT_EQ(lost(6).codes, "E-NONFINITE");
  EXPECT_EQ(lost(6).exit, 4);
}

TEST(ReadTrajectory, CommaSeparatedTumIsAssumed) {
  const ScratchFolder folder;
  const Outcome outcome = trajectory_outcome(folder.write("f", replaced(tum_text(), " ", ",")));
  EXPECT_EQ(outcome.codes, "W-COLUMNS");
  EXPECT_EQ(outcome.kept, 500);
}

TEST(ReadTrajectory, NamesBeatPositions) {
  const ScratchFolder folder;
  const std::string rows = "0.01 1 2 3 0.5 0.1 0.1 -0.8544003745317531\n0.02 1 2 3 0.5 0.1 0.1 -0.8544003745317531\n";
  const auto first = read_trajectory(folder.write("f", "# timestamp tx ty tz qx qy qz qw\n" + rows)).value.value[0];
  const auto other = read_trajectory(folder.write("f", "t px py pz qw qx qy qz\n" + rows)).value.value[0];
  EXPECT_TRUE(first.R.isApprox(Eigen::Quaterniond(-0.8544003745317531, 0.5, 0.1, 0.1).toRotationMatrix(), 1e-15));
  EXPECT_TRUE(other.R.isApprox(Eigen::Quaterniond(0.5, 0.1, 0.1, -0.8544003745317531).toRotationMatrix(), 1e-15));
}

TEST(Content, TellsImuFromTrajectory) {
  const ScratchFolder folder;
  EXPECT_EQ(content_of(folder.write("f", text_of(healthy()))), ContentKind::kImu);
  EXPECT_EQ(content_of(folder.write("f", tum_text())), ContentKind::kTrajectory);
  EXPECT_EQ(
      content_of(folder.write(
          "f",
          "index,gx,gy,gz,ax,ay,az,qw,qx,qy,qz,px,py,pz\n0,1,2,3,4,5,6,1,0,0,0,1,2,3\n1,1,2,3,4,5,6,1,0,0,0,1,2,3\n")),
      ContentKind::kBoth);
  EXPECT_THROW(content_of(folder.write("f", "a,b,c\n1,2,3\n")), Error);
  EXPECT_THROW(content_of(folder.path("absent")), Error);
}

}  // namespace
}  // namespace vispline
