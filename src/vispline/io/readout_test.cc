#include "vispline/io/readout.h"

#include "vispline/io/io_testing.h"
#include "vispline/io/write.h"

namespace vispline {
namespace {

TEST(Readout, MarsLogger) {
  const ScratchFolder folder;
  std::string text =
      "Timestamp[nanosec],fx[px],fy[px],Frame No.,Exposure time[nanosec],Sensor frame duration[nanosec],Frame readout "
      "time[nanosec],ISO,Focal length,Focus distance,AF mode,Unix time[nanosec]\n";
  for (int i = 0; i < 9; ++i) {
    text += std::to_string(1'000'000'000 + 33'333'333LL * i) + ",1480.1,1480.1," + std::to_string(i) +
            ",10000000,33333333," +
            (i == 2   ? "0"
             : i == 3 ? "90000000"
                      : "28500000") +
            ",400,4.3,0.2,0,1588888888\n";
  }
  const auto readout = read_readout(folder.write("movie_metadata.csv", text));
  ASSERT_TRUE(readout.has_value());
  EXPECT_DOUBLE_EQ(readout->seconds, 0.0285);
  EXPECT_EQ(readout->source, "Frame readout time[nanosec]");
}

TEST(Readout, GyroflowLog) {
  const ScratchFolder folder;
  write_imu_gcsv(folder.path("a.gcsv"), random_imu(12, 1), 0.0162);
  const auto readout = read_readout(folder.path("a.gcsv"));
  ASSERT_TRUE(readout.has_value());
  EXPECT_DOUBLE_EQ(readout->seconds, 0.0162);
  write_imu_gcsv(folder.path("b.gcsv"), random_imu(12, 1));
  EXPECT_FALSE(read_readout(folder.path("b.gcsv")).has_value());
  write_imu_csv(folder.path("c.csv"), random_imu(12, 1));
  EXPECT_FALSE(read_readout(folder.path("c.csv")).has_value());
}

}  // namespace
}  // namespace vispline
