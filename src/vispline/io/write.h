/// Signals to files that the next tool reads. docs/formats.md.
#pragma once

#include <optional>
#include <string>

#include "vispline/core/pose.h"
#include "vispline/core/signal.h"
#include "vispline/files/output_file.h"
#include "vispline/io/euroc_groundtruth.h"
#include "vispline/sensors/recording.h"

namespace vispline {

/// EuRoC imu0 CSV in blocks: a day of samples never stands in memory.
class ImuCsvWriter {
 public:
  explicit ImuCsvWriter(std::string path, OutputOptions options = {});
  /// The stamps must follow those of the block before.
  void write(const ImuSignal& block);
  /// The file has no name until then.
  void publish() { file_.publish(); }

 private:
  OutputFile file_;
  std::string text_;
};

/// EuRoC ground truth in blocks: the 17 columns.
class GroundTruthCsvWriter {
 public:
  explicit GroundTruthCsvWriter(std::string path, OutputOptions options = {});
  /// The stamps must follow those before.
  void write(Time time, const GroundTruth& state);
  /// The file has no name until then.
  void publish();

 private:
  OutputFile file_;
  std::string text_;
};

/// About how many bytes `rows` rows of EuRoC imu0 CSV take; for probe_output.
std::uint64_t imu_csv_bytes(std::uint64_t rows);

void write_imu_csv(const std::string& path, const ImuSignal& imu, OutputOptions options = {});
/// TUM text: `timestamp tx ty tz qx qy qz qw`.
void write_trajectory_tum(const std::string& path, const Signal<Pose>& T_w_b, OutputOptions options = {});
/// The 8 columns of EuRoC and TUM-VI: ns, position, quaternion with w first.
void write_trajectory_euroc(const std::string& path, const Signal<Pose>& T_w_b, OutputOptions options = {});
/// KITTI text: the upper three rows of each pose, without its time.
void write_trajectory_kitti(const std::string& path, const Signal<Pose>& T_w_b, OutputOptions options = {});
/// Gyroflow's .gcsv, stamps in ns, rad/s and m/s^2, axes as they are (orientation XYZ). `readout_s` of the camera, if
/// it is known.
void write_imu_gcsv(const std::string& path, const ImuSignal& imu, std::optional<double> readout_s = {},
                    OutputOptions options = {});
/// The 17 columns of EuRoC ground truth.
void write_groundtruth_euroc(const std::string& path, const Signal<GroundTruth>& states, OutputOptions options = {});

}  // namespace vispline
