/// Shared by the tests of this folder: scratch folders, generated tables, the outcome of a reader as plain values.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "vispline/core/random.h"
#include "vispline/core/so3.h"
#include "vispline/io/read.h"

namespace vispline {

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "vispline_io_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string path(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::string path_;
};

inline std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Random numbers of one test, in order.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : stream_(seed, "io test") {}
  double normal() { return stream_.normal(next_++); }
  Vector3d vector() { return {normal(), normal(), normal()}; }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

inline ImuSignal random_imu(std::size_t rows, std::uint64_t seed, std::int64_t start_ns = 1520530308181901469) {
  Numbers numbers(seed);
  ImuSignal imu;
  for (std::size_t i = 0; i < rows; ++i) {
    imu.push_back(time_from_ns(start_ns + 5'016'003 * static_cast<std::int64_t>(i)),
                  {numbers.vector(), numbers.vector() + Vector3d(0, 0, 9.81)});
  }
  return imu;
}

inline Signal<Pose> random_poses(std::size_t rows, std::uint64_t seed, std::int64_t start_ns = 1520530308189679351) {
  Numbers numbers(seed);
  Signal<Pose> poses;
  for (std::size_t i = 0; i < rows; ++i) {
    poses.push_back(time_from_ns(start_ns + 8'333'001 * static_cast<std::int64_t>(i)),
                    {SO3::exp<double>(numbers.vector()), numbers.vector()});
  }
  return poses;
}

/// What a reader did: the code of its error, or the codes of its warnings.
struct Outcome {
  int exit = 0;
  std::string codes;  ///< "W-GAP W-RATE" or the one "E-..."
  std::int64_t read = 0, kept = 0;
  std::string where, message, next;
};

template <class Reader>
Outcome outcome_of(const Reader& reader) {
  Outcome outcome;
  try {
    const auto result = reader();
    for (const auto& [code, count] : result.diagnostics.counts())
      outcome.codes += (outcome.codes.empty() ? "" : " ") + code;
    outcome.read = result.counts.read;
    outcome.kept = result.counts.kept;
    EXPECT_EQ(result.counts.read, result.counts.kept + result.counts.dropped_total());
    EXPECT_EQ(static_cast<std::size_t>(result.counts.kept), result.value.size());
    EXPECT_EQ(result.value.time.size(), result.value.value.size());
    for (std::size_t i = 1; i < result.value.size(); ++i) EXPECT_LT(result.value.time[i - 1], result.value.time[i]);
  } catch (const Error& error) {
    outcome.exit = static_cast<int>(error.exit_code());
    outcome.codes = error.diagnostic().code;
    outcome.where = error.diagnostic().where;
    outcome.message = error.diagnostic().message;
    outcome.next = error.diagnostic().next;
  }
  return outcome;
}

inline Outcome imu_outcome(const std::string& path, const ReadOptions& options = {}) {
  return outcome_of([&] { return read_imu(path, options); });
}
inline Outcome trajectory_outcome(const std::string& path, const ReadOptions& options = {}) {
  return outcome_of([&] { return read_trajectory(path, options); });
}

}  // namespace vispline
