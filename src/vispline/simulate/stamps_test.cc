#include "vispline/simulate/stamps.h"

#include <gtest/gtest.h>

#include <limits>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr Duration kDay = std::chrono::hours(24);
const Time kStart = time_from_ns(1600000000123456789);

TEST(Stamps, ADayAt200HzDoesNotDrift) {
  const Stamps stamps(SampleClock{kStart, 200.0}, kDay);
  ASSERT_EQ(stamps.size(), 17280000u);
  EXPECT_EQ(stamps[0], kStart);
  EXPECT_EQ(stamps[stamps.size() - 1], kStart + kDay - std::chrono::milliseconds(5));
  EXPECT_EQ(stamps.step(17279999), 0.005);
  Time before = stamps[0];
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const Time now = stamps[i];
    ASSERT_EQ(now - before, std::chrono::milliseconds(5)) << i;
    before = now;
  }
}

TEST(Stamps, APeriodThatIsNoWholeNumberOfNanosecondsDoesNotDriftEither) {
  // A third of a nanosecond lost per sample would be 8.6 ms after a day at 300 Hz.
  const Stamps stamps(SampleClock{kStart, 300.0}, kDay);
  ASSERT_EQ(stamps.size(), 300u * 86400u);
  for (std::size_t second = 0; second < 86400; second += 7) {
    ASSERT_EQ(stamps[300 * second], kStart + std::chrono::seconds(second));
    const Duration step = stamps[300 * second + 1] - stamps[300 * second];
    ASSERT_EQ(step.count(), 3333333);
  }
}

TEST(Stamps, CountsAHalfOpenInterval) {
  const auto count = [](double rate_hz, double seconds) {
    return Stamps(SampleClock{kStart, rate_hz}, from_seconds(seconds)).size();
  };
  EXPECT_EQ(count(200.0, 20.0), 4000u);
  EXPECT_EQ(count(200.0, 20.004), 4001u);
  EXPECT_EQ(count(200.0, 0.001), 1u);
  EXPECT_EQ(count(201.9, 10.0), 2019u);
  EXPECT_EQ(count(1e8, 1e-6), 100u);
}

TEST(Stamps, AListIsKeptAsItIs) {
  const std::vector<Time> list{time_from_ns(-5),       time_from_ns(0),        time_from_ns(10000000),
                               time_from_ns(21000000), time_from_ns(61000000), time_from_ns(71000000)};
  const Stamps stamps(list);
  ASSERT_EQ(stamps.size(), list.size());
  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(stamps[i], list[i]);
  EXPECT_DOUBLE_EQ(stamps.period(), 0.01);
  EXPECT_DOUBLE_EQ(stamps.step(2), 0.011);
  EXPECT_DOUBLE_EQ(stamps.step(3), 0.04);
  EXPECT_DOUBLE_EQ(stamps.step(5), 0.01);            // where the next one would be
  EXPECT_DOUBLE_EQ(stamps.averaging_time(0), 0.01);  // unknown: one period
  EXPECT_DOUBLE_EQ(stamps.averaging_time(3), 0.011);
  EXPECT_DOUBLE_EQ(stamps.averaging_time(4), 0.01);  // after the gap
}

std::string code_of(const auto& make) {
  try {
    make();
  } catch (const Error& error) {
    return error.diagnostic().code;
  }
  return "accepted";
}

TEST(Stamps, RefusesWhatIsNoSequence) {
  const auto list = [](std::vector<std::int64_t> ns) {
    return [ns] {
      std::vector<Time> stamps;
      for (const std::int64_t t : ns) stamps.push_back(time_from_ns(t));
      return Stamps(stamps);
    };
  };
  const auto clock = [](double rate_hz, Duration duration) {
    return [=] { return Stamps(SampleClock{kStart, rate_hz}, duration); };
  };
  EXPECT_EQ(code_of(list({})), "E-TOO-SHORT");
  EXPECT_EQ(code_of(list({7})), "E-TOO-SHORT");
  EXPECT_EQ(code_of(list({7, 7})), "E-ORDER");
  EXPECT_EQ(code_of(list({1, 3, 2})), "E-ORDER");
  EXPECT_EQ(code_of(list({1, 2})), "accepted");
  EXPECT_EQ(code_of(clock(0.0, kDay)), "E-ARGUMENT");
  EXPECT_EQ(code_of(clock(-1.0, kDay)), "E-ARGUMENT");
  EXPECT_EQ(code_of(clock(std::numeric_limits<double>::quiet_NaN(), kDay)), "E-ARGUMENT");
  EXPECT_EQ(code_of(clock(2e8, Duration(100))), "E-ARGUMENT");
  EXPECT_EQ(code_of(clock(100.0, Duration(0))), "E-ARGUMENT");
}

}  // namespace
}  // namespace vispline
