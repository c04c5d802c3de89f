#include "vispline/io/rhythm.h"

#include <gtest/gtest.h>

namespace vispline {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'123'456'789;

TEST(Rhythm, OfNothingAndOfOne) {
  RhythmMeter meter;
  EXPECT_EQ(meter.rhythm().count, 0);
  meter.add(kStart);
  EXPECT_EQ(meter.rhythm().begin_ns, kStart);
  EXPECT_FALSE(meter.rhythm().rate_hz());
  EXPECT_FALSE(meter.rhythm().jitter);
}

TEST(Rhythm, RateJitterAndGaps) {
  RhythmMeter meter;
  std::int64_t ns = kStart;
  for (int i = 0; i <= 1000; ++i) {
    meter.add(ns);
    ns += i == 500 ? 750'000'000 : (i == 700 ? 400'000'000 : (i % 2 == 0 ? 4'000'000 : 6'000'000));
  }
  const Rhythm r = meter.rhythm();
  EXPECT_EQ(r.count, 1001);
  EXPECT_NEAR(*r.rate_hz(), 1000.0 / (998 * 0.005 + 0.002 + 1.15), 0.5);
  EXPECT_NEAR(*r.jitter, 0.5 * 2.0 / 6.0, 0.1);
  EXPECT_EQ(r.gaps, 2);
  EXPECT_EQ(r.gaps_ns, 1'150'000'000);
  ASSERT_EQ(r.longest_gaps.size(), 2u);
  EXPECT_EQ(r.longest_gaps[0].length_ns, 750'000'000);
  EXPECT_EQ(r.longest_gaps[1].length_ns, 400'000'000);
}

TEST(Rhythm, OrderAndDuplicates) {
  RhythmMeter meter;
  for (const std::int64_t ms : {0, 10, 20, 15, 30, 30, 40, 50}) meter.add(kStart + ms * 1'000'000);
  const Rhythm r = meter.rhythm();
  EXPECT_EQ(r.out_of_order, 1);
  EXPECT_EQ(r.duplicates, 1);
  EXPECT_EQ(r.end_ns - r.begin_ns, 50'000'000);
  EXPECT_EQ(r.median_step_ns, 10'000'000);
}

TEST(Rhythm, StampsAnywhereIn64Bits) {
  RhythmMeter meter;
  for (const std::int64_t ns : {INT64_MIN, INT64_MAX, std::int64_t{0}, INT64_MIN}) meter.add(ns);
  EXPECT_EQ(meter.rhythm().count, 4);
  EXPECT_GT(meter.rhythm().duration_s(), 1e10);
}

}  // namespace
}  // namespace vispline
