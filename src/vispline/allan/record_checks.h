/// Is a record fit for noise identification? Motion, drift, spikes, held samples, coarse readings: found while it
/// streams by, said before the numbers. docs/math/allan.md, Checks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vispline/core/error.h"

namespace vispline {

/// Windows of about a second, merged in pairs when there are too many.
class RecordChecks {
 public:
  /// `names` of the axes, for the messages: "gyroscope x [rad/s]".
  explicit RecordChecks(std::vector<std::string> names);

  /// The next readings, axis by axis, all of the same length; `index` counts readings from the start of the file.
  void push(std::span<const std::span<const double>> axes);
  void end_segment();
  /// What was found; the rate places it in time.
  Diagnostics finish(double rate_hz) const;

 private:
  struct Window {
    std::int64_t first = 0, count = 0;
    std::vector<double> mean, square;  ///< per axis: mean, sum of squares about it
  };
  void add(std::size_t begin, std::size_t end, std::span<const std::span<const double>> axes);
  void close_window();
  void merge_pairs();
  void check_motion(Diagnostics& found, double rate_hz) const;
  void check_drift(Diagnostics& found, double rate_hz) const;
  void check_spikes(Diagnostics& found, double rate_hz) const;
  void check_quantum(Diagnostics& found) const;
  void check_held(Diagnostics& found) const;

  std::vector<std::string> names_;
  std::vector<Window> windows_;
  Window open_;
  std::int64_t window_length_ = 64;
  std::int64_t readings_ = 0, held_ = 0;
  std::vector<double> last_;
  std::vector<double> spread_;  ///< of the last closed window, per axis
  std::vector<double> centre_;
  std::vector<std::int64_t> spikes_, first_spike_;
  std::vector<std::vector<double>> sample_;  ///< the first readings of each axis
};

}  // namespace vispline
