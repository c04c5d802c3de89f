#include "vispline/core/time.h"

#include <gtest/gtest.h>

#include "vispline/core/signal.h"

namespace vispline {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

TEST(Time, NanosecondsAreExactAboveWhatADoubleHolds) {
  const std::int64_t ns = 1403636579763555584;  // not representable in a double of seconds
  EXPECT_EQ(to_ns(time_from_ns(ns)), ns);
  EXPECT_EQ(to_ns(time_from_ns(ns + 1)) - to_ns(time_from_ns(ns)), 1);
}

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(from_seconds(0.1).count(), 100'000'000);
  EXPECT_EQ(from_seconds(-1e-9).count(), -1);
  EXPECT_EQ(from_seconds(1.4e-9).count(), 1);
  EXPECT_EQ(from_seconds(1.6e-9).count(), 2);
  EXPECT_DOUBLE_EQ(to_seconds(from_seconds(12.345678901)), 12.345678901);
}

TEST(TimeSpan, IsClosedAtBothEnds) {
  const TimeSpan span{time_from_ns(10), time_from_ns(20)};
  EXPECT_TRUE(span.contains(time_from_ns(10)));
  EXPECT_TRUE(span.contains(time_from_ns(20)));
  EXPECT_FALSE(span.contains(time_from_ns(9)));
  EXPECT_FALSE(span.contains(time_from_ns(21)));
  EXPECT_DOUBLE_EQ(span.seconds(), 1e-8);
}

TEST(SampleClock, CountsAHalfOpenInterval) {
  EXPECT_EQ((SampleClock{.rate_hz = 200.0}.count(seconds(20))), 4000);
  EXPECT_EQ((SampleClock{.rate_hz = 200.0}.count(hours(24))), 17'280'000);
  EXPECT_EQ((SampleClock{.rate_hz = 30.0}.count(seconds(20))), 600);
  EXPECT_EQ((SampleClock{.rate_hz = 200.0}.count(Duration(5'000'000))), 1);
  EXPECT_EQ((SampleClock{.rate_hz = 200.0}.count(Duration(5'000'001))), 2);
  EXPECT_EQ((SampleClock{.rate_hz = 200.0}.count(Duration(0))), 0);
}

TEST(SampleClock, EverySampleLiesInsideAndTheNextOneDoesNot) {
  for (const double rate_hz : {1.0, 29.97, 30.0, 100.0 / 3.0, 200.0, 2000.0 / 7.0, 286.0, 1000.0, 8000.0}) {
    const SampleClock clock{.start = time_from_ns(1403636579763555584), .rate_hz = rate_hz};
    for (const Duration duration : {Duration(seconds(20)), Duration(999'999'999), Duration(hours(24))}) {
      const std::int64_t n = clock.count(duration);
      EXPECT_LT(clock(n - 1), clock.start + duration) << rate_hz;
      EXPECT_GE(clock(n), clock.start + duration) << rate_hz;
    }
  }
}

TEST(SampleClock, StampsIncreaseStrictlyAndDoNotDrift) {
  for (const double rate_hz : {286.0, 2000.0 / 7.0}) {
    const SampleClock clock{.rate_hz = rate_hz};
    const auto period = static_cast<std::int64_t>(1e9 / rate_hz);
    const std::int64_t n = clock.count(hours(1));
    for (std::int64_t i = 1; i < n; ++i) {
      const std::int64_t step = to_ns(clock(i)) - to_ns(clock(i - 1));
      ASSERT_TRUE(step == period || step == period + 1) << "sample " << i << " step " << step;
    }
  }
  // 2000/7 Hz has a period of exactly 3.5 ms: after a day the stamp is still a multiple of it.
  EXPECT_EQ(to_ns(SampleClock{.rate_hz = 2000.0 / 7.0}(24'685'714)), 24'685'714 * std::int64_t{3'500'000});
}

TEST(Signal, KeepsStampsAndValuesTogether) {
  Signal<double> signal;
  EXPECT_TRUE(signal.empty());
  signal.push_back(time_from_ns(5), 1.5);
  signal.push_back(time_from_ns(9), 2.5);
  EXPECT_EQ(signal.size(), 2u);
  EXPECT_EQ(to_ns(signal.span().begin), 5);
  EXPECT_EQ(to_ns(signal.span().end), 9);
  EXPECT_EQ(signal.value.back(), 2.5);
}

}  // namespace
}  // namespace vispline
