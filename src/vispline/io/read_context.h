/// What the checks of one file share: its name, the flags, the counts and the warnings so far.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "vispline/core/error.h"
#include "vispline/io/read_options.h"

namespace vispline {

/// A loss of up to 0.1 % of the rows warns, up to 1 % warns loudly, above that fails unless repair is asked for.
inline constexpr double kQuietLoss = 0.001;
inline constexpr double kLoudLoss = 0.01;

class ReadContext {
 public:
  /// `noun` is what the file is asked for: "IMU samples", "poses".
  ReadContext(std::string path, std::string noun, ReadOptions options);

  ReadCounts counts;
  Diagnostics diagnostics;

  const std::string& path() const { return path_; }
  const std::string& noun() const { return noun_; }
  const ReadOptions& options() const { return options_; }

  /// The place of a row: file:line, from 1, or whatever else the rows of this file are counted in.
  std::string where_line(std::int64_t line) const { return path_ + between_ + std::to_string(line); }
  /// Rows are found by another number than their line; `between` stands between file and number: ", byte ".
  void name_places(std::string between) { between_ = std::move(between); }

  void warn(std::string code, std::string message, std::string where, std::string effect, std::string next = "");
  /// One row is left out: warned about and counted.
  void drop(const std::string& code, std::string message, std::string where);
  [[noreturn]] void fail(ExitCode exit_code, std::string code, std::string message, std::string where,
                         std::string next) const;
  /// Share of the rows read, 0..1.
  double share(std::int64_t rows) const;
  /// Is the loss of `rows` above 1 %, and is --repair not given?
  bool too_many(std::int64_t rows) const { return share(rows) > kLoudLoss && !options_.repair; }

 private:
  std::string path_;
  std::string between_ = ":";
  std::string noun_;
  ReadOptions options_;
};

/// "3.25 %"
std::string percent(double share);

}  // namespace vispline
