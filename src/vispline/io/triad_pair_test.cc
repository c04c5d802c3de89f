#include "vispline/io/triad_pair.h"

#include <gtest/gtest.h>

namespace vispline {
namespace {

/// The two sensors one behind the other in the file.
TEST(ImuPairing, OneStreamMayWaitForTheOther) {
  std::vector<SensorRow> paired;
  int alone = 0;
  ImuPairing pairing([&](const SensorRow& row) { paired.push_back(row); }, [&](const SensorRow&) { ++alone; });
  std::vector<SensorRow> gyro, accel;
  for (std::int64_t i = 0; i < 1000; ++i) {
    gyro.push_back({.ns = 10 * i, .values = {1.0, 2.0, 3.0}});
    accel.push_back({.ns = 10 * i + 5, .values = {static_cast<double>(i), 0.0, 0.0}});
  }
  EXPECT_TRUE(pairing.push_gyro(gyro));
  EXPECT_TRUE(paired.empty());
  EXPECT_TRUE(pairing.push_accel(accel));
  pairing.finish();
  EXPECT_EQ(alone, 1);
  ASSERT_EQ(paired.size(), 999u);
  EXPECT_EQ(paired[0].ns, 10);
  EXPECT_DOUBLE_EQ(paired[0].values[3], 0.5);
}

TEST(ImuPairing, NotWithoutEnd) {
  ImuPairing pairing([](const SensorRow&) {}, [](const SensorRow&) {});
  const std::vector<SensorRow> block(1 << 18);
  bool fits = true;
  for (int i = 0; i < 5; ++i) fits = pairing.push_gyro(block);
  EXPECT_FALSE(fits);
}

}  // namespace
}  // namespace vispline
