/// What a streamed reading did, as plain values that can be compared.
#pragma once

#include <string>
#include <vector>

#include "vispline/io/imu_stream.h"
#include "vispline/io/read_testing.h"

namespace vispline {

struct Streamed {
  std::string error;  ///< "E-CSV at f:7: message", or empty
  std::vector<std::string> warnings;
  ReadCounts counts;
  ImuSignal imu;
  ImuStreamResult result;
};

/// The samples of a file; stamps must strictly increase over all calls of the sink.
inline Streamed streamed(const std::string& path, const ReadOptions& options = {},
                         const ImuStreamSettings& settings = {}) {
  Streamed out;
  const auto sink = [&out](std::span<const Time> time, std::span<const ImuSample> samples) {
    ASSERT_EQ(time.size(), samples.size());
    ASSERT_FALSE(time.empty());
    for (std::size_t i = 0; i < time.size(); ++i) {
      ASSERT_TRUE(out.imu.empty() || out.imu.time.back() < time[i]);
      out.imu.push_back(time[i], samples[i]);
    }
  };
  try {
    out.result = stream_imu(path, options, sink, settings);
    out.counts = out.result.counts;
    for (const auto& [code, count] : out.result.diagnostics.counts())
      out.warnings.push_back(code + " x" + std::to_string(count));
    for (const Diagnostic& example : out.result.diagnostics.examples()) out.warnings.push_back(to_text(example));
    EXPECT_EQ(out.counts.read, out.counts.kept + out.counts.dropped_total());
    EXPECT_EQ(static_cast<std::size_t>(out.counts.kept), out.imu.size());
  } catch (const Error& error) {
    out.error = to_text(error.diagnostic());
    out.imu = {};
  }
  return out;
}

inline void expect_same_samples(const ImuSignal& a, const ImuSignal& b) {
  ASSERT_EQ(a.time, b.time);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a.value[i].gyro, b.value[i].gyro) << i;
    ASSERT_EQ(a.value[i].accel, b.value[i].accel) << i;
  }
}

inline void expect_same(const Streamed& a, const Streamed& b) {
  ASSERT_EQ(a.error, b.error);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.counts.read, b.counts.read);
  EXPECT_EQ(a.counts.dropped, b.counts.dropped);
  expect_same_samples(a.imu, b.imu);
}

}  // namespace vispline
