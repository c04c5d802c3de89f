#include "vispline/io/gopro.h"

#include "vispline/io/io_testing.h"
#include "vispline/io/readout.h"
#include "vispline/io/recorders_testing.h"
#include "vispline/io/sample_clock_fit.h"

namespace vispline {
namespace {

using namespace recorders_testing;

TEST(Gopro, SamplesAxesAndClock) {
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("v.mp4", small_gopro_mp4()));
  EXPECT_EQ(read.format, "gopro");
  ASSERT_EQ(read.counts.kept, 60);
  EXPECT_EQ(read.counts.read, 60);
  for (std::size_t k = 0; k < 60; ++k) {
    const double n = static_cast<double>(k);
    // channels X -Z Y of the file to X Y Z
    EXPECT_LE((read.value.value[k].gyro - Vector3d(0.01 * n, 0.5, 0.02 * n)).norm(), 1e-12) << k;
    EXPECT_LE((read.value.value[k].accel - Vector3d(1.0, 0.03 * n, 9.81)).norm(), 0.01) << k;
    EXPECT_NEAR(static_cast<double>(to_ns(read.value.time[k])), 250e6 + 1e9 / 200.5 * n, 1000.0) << k;
  }
}

TEST(Gopro, WithoutStampsTheContainerTellsTheTime) {
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("v.mp4", small_gopro_mp4(false)));
  ASSERT_EQ(read.counts.kept, 60);
  EXPECT_EQ(to_ns(read.value.time.front()), 0);
  EXPECT_NEAR(static_cast<double>(to_ns(read.value.time.back())), 59 * 5e6, 1.0);  // 20 samples in 0.1 s
}

TEST(Gopro, BarePayloadsAreSpreadWithAWarning) {
  const ScratchFolder folder;
  const auto read = read_imu(folder.write("p.raw", small_gopro_payload(0, false) + small_gopro_payload(1, false)));
  EXPECT_EQ(read.counts.kept, 40);
  EXPECT_GE(read.diagnostics.counts().at("W-CLOCK"), 1);
  EXPECT_NEAR(static_cast<double>(to_ns(read.value.time[20])), 1.001e9, 1.0);
}

// Memory is that of some windows, however long the recording is, and no sample is lost to rounding.
TEST(Gopro, LongRecordingInWindows) {
  std::string bytes;
  for (int i = 0; i < 3000; ++i) bytes += small_gopro_payload(i, false);
  const auto read =
      gopro::stream(Input::from_memory(bytes, "long"), {}, kNoSink, {.window_rows = 64, .whole_imu = true});
  EXPECT_EQ(read.counts.read, 60000);
  EXPECT_EQ(read.counts.kept, 60000);
  EXPECT_LE(read.largest_window, 8u * 64u);
}

TEST(Gopro, AxesByFlag) {
  const ScratchFolder folder;
  const std::string path = folder.write("v.mp4", small_gopro_mp4());
  const auto read = read_imu(path, {.imu_axes = "yXZ"});  // channel 0 is -Y, 1 is X, 2 is Z
  EXPECT_LE((read.value.value[10].gyro - Vector3d(-0.2, -0.1, 0.5)).norm(), 1e-12);
  const Outcome bad = imu_outcome(path, {.imu_axes = "XXZ"});
  EXPECT_EQ(bad.codes, "E-ARGUMENT");
  EXPECT_EQ(bad.exit, 2);
}

TEST(Gopro, ReadoutTime) {
  const ScratchFolder folder;
  const auto readout = read_readout(folder.write("v.mp4", small_gopro_mp4()));
  ASSERT_TRUE(readout.has_value());
  EXPECT_NEAR(readout->seconds, 0.0206, 1e-8);
  EXPECT_EQ(readout->source, "SROT");
}

// Whatever is missing at the end: no crash, and never more samples than of a longer piece.
TEST(Gopro, CutAtEveryByte) {
  for (const bool container : {false, true}) {
    const std::string whole = container ? small_gopro_mp4(true, 2) : small_gopro_payload(0, false);
    std::int64_t most = 0;
    for (std::size_t size = 0; size <= whole.size(); ++size) {
      std::int64_t kept = 0;
      try {
        kept = gopro::stream(Input::from_memory(whole.substr(0, size), "cut"), {}, kNoSink, {.whole_imu = true})
                   .counts.kept;
      } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().code.substr(0, 2), "E-");
      }
      EXPECT_GE(kept, most) << size;
      most = std::max(most, kept);
    }
    EXPECT_EQ(most, container ? 40 : 20);
  }
}

// The index of a video stands at its end.
TEST(Gopro, VideoThatIsCut) {
  const ScratchFolder folder;
  const std::string whole = small_gopro_mp4();
  const auto read =
      read_imu(folder.write("v.mp4", whole.substr(0, whole.size() - 4)));  // the place of the last payload
  EXPECT_EQ(read.counts.kept, 40);
  EXPECT_EQ(read.diagnostics.counts().at("W-CORRUPT"), 1);
  const Outcome before = imu_outcome(folder.write("w.mp4", whole.substr(0, whole.size() / 2)));
  EXPECT_EQ(before.codes, "E-CORRUPT");
  EXPECT_EQ(before.exit, 3);
}

TEST(SampleClock, LeastSquaresOfALine) {
  std::vector<ClockPoint> points;
  for (int i = 0; i < 9; ++i) points.push_back({198 * i + 5, 1e6 + 0.0050633 * (198 * i + 5) + (i % 2 ? 1e-4 : -1e-4)});
  const auto clock = fit_clock(points);
  ASSERT_TRUE(clock.has_value());
  EXPECT_NEAR(clock->period_s, 0.0050633, 1e-7);
  EXPECT_NEAR(clock->start_s, 1e6, 2e-4);
  EXPECT_LE(clock->largest_s, 1.3e-4);
  EXPECT_FALSE(fit_clock(std::vector<ClockPoint>{{3, 1.0}, {3, 2.0}}).has_value());
}

std::string gopro_data(const std::string& name) {
  return std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/rolling_shutter/gopro/" + name;
}

TEST(Gopro, RecordedVideo) {
  if (!std::filesystem::exists(gopro_data("max-heromode.mp4"))) GTEST_SKIP() << "no recorded data at hand";
  const auto read = read_imu(gopro_data("max-heromode.mp4"));
  const double seconds = read.value.span().seconds();
  EXPECT_NEAR(static_cast<double>(read.value.size() - 1) / seconds, 197.5, 0.5);
  EXPECT_NEAR(seconds, 10.5, 0.2);
  Vector3d mean = Vector3d::Zero();
  double norm = 0.0;
  for (const ImuSample& sample : read.value.value) {
    mean += sample.accel / static_cast<double>(read.value.size());
    norm += sample.accel.norm() / static_cast<double>(read.value.size());
  }
  EXPECT_NEAR(norm, 9.83, 0.05);
  EXPECT_GT(mean.z(), 8.0);  // held upright
  EXPECT_NEAR(read_readout(gopro_data("max-heromode.mp4"))->seconds, 0.0206, 1e-4);
}

TEST(Gopro, RecordedPayloads) {
  if (!std::filesystem::exists(gopro_data("hero5.raw"))) GTEST_SKIP() << "no recorded data at hand";
  EXPECT_EQ(read_imu(gopro_data("hero5.raw")).counts.read, 399);
  EXPECT_EQ(read_imu(gopro_data("hero6.raw")).counts.read, 204);
}

}  // namespace
}  // namespace vispline
