/// The checks of stamps and values, without a file.
#include "vispline/io/imu_screen.h"

#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

struct Screened {
  std::string codes;
  ReadCounts counts;
  ImuSignal imu;
};

/// Pushes rows whose stamps are `ns`, or those of `imu` itself.
Screened screened(const ImuSignal& imu, const ReadOptions& options = {}) {
  ReadContext context("bag:/imu", "IMU samples", options);
  Screened out;
  ImuScreen screen(context, [&](std::span<const Time> time, std::span<const ImuSample> samples) {
    for (std::size_t i = 0; i < time.size(); ++i) out.imu.push_back(time[i], samples[i]);
  });
  try {
    for (std::size_t i = 0; i < imu.size(); ++i) {
      ++context.counts.read;
      screen.push(to_ns(imu.time[i]), imu.value[i], static_cast<std::int64_t>(i));
    }
    screen.flush();
    screen.finish();
  } catch (const Error& error) {
    out.codes = error.diagnostic().code + " " + error.diagnostic().where;
    return out;
  }
  for (const auto& [code, count] : context.diagnostics.counts()) out.codes += (out.codes.empty() ? "" : " ") + code;
  out.counts = context.counts;
  EXPECT_EQ(out.counts.read, out.counts.kept + out.counts.dropped_total());
  EXPECT_EQ(static_cast<std::size_t>(out.counts.kept), out.imu.size());
  return out;
}

TEST(ImuScreen, PassesAHealthyRecordingUnchanged) {
  const ImuSignal imu = random_imu(30000, 3);
  const Screened got = screened(imu);
  EXPECT_EQ(got.codes, "");
  ASSERT_EQ(got.imu.time, imu.time);
  for (std::size_t i = 0; i < imu.size(); ++i) ASSERT_EQ(got.imu.value[i].accel, imu.value[i].accel);
}

TEST(ImuScreen, LeavesOutAndSorts) {
  ImuSignal imu = random_imu(20000, 4);
  imu.value[7000].gyro.y() = NAN;
  std::swap(imu.time[9000], imu.time[9001]);
  imu.time[12000] += Duration(std::int64_t{86400'000'000'000});
  imu.time[15000] = time_from_ns(-5);
  imu.time[16000] = imu.time[15999];
  const Screened got = screened(imu);
  EXPECT_EQ(got.codes, "W-DUPLICATE W-NONFINITE W-ORDER W-TIME-OUTLIER W-TIME-RANGE");
  EXPECT_EQ(got.counts.kept, 19996);
}

TEST(ImuScreen, SaysWhere) {
  ImuSignal imu = random_imu(20000, 5);
  for (std::size_t i = 12345; i < imu.size(); ++i) imu.time[i] -= Duration(std::int64_t{60'000'000'000});
  EXPECT_EQ(screened(imu).codes, "E-TIME-RESET bag:/imu:12345");
  EXPECT_EQ(screened({}).codes, "E-EMPTY bag:/imu");
}

TEST(ImuScreen, EveryRowIsOneSampleOrOneReason) {
  const RandomStream random(6, "screen");
  for (std::uint64_t round = 0; round < 40; ++round) {
    ImuSignal imu = random_imu(3000, 100 + round);
    for (std::uint64_t k = 0; k < 12; ++k) {  // faults anywhere, also on top of each other
      const auto u = random.uniform_pair(round * 100 + k);
      const auto i = static_cast<std::size_t>(u[0] * 2998.0) + 1;
      const int kind = static_cast<int>(u[1] * 5.0);
      if (kind == 0) std::swap(imu.time[i], imu.time[i - 1]);
      if (kind == 1) imu.time[i] = imu.time[i - 1];
      if (kind == 2) imu.value[i].accel.x() = INFINITY;
      if (kind == 3) imu.time[i] += Duration(std::int64_t{1} << 60);
      if (kind == 4) imu.value[i].gyro.z() = 1e6;
    }
    const Screened got = screened(imu, {.repair = true});
    ASSERT_GE(got.imu.size(), 2980u) << got.codes;
    for (std::size_t i = 1; i < got.imu.size(); ++i) ASSERT_LT(got.imu.time[i - 1], got.imu.time[i]);
  }
}

}  // namespace
}  // namespace vispline
