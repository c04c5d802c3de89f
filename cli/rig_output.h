/// The folder of a simulated rig: EuRoC files, tracks, truth, the rig itself. docs/formats.md, Simulated rigs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rig_scene.h"
#include "vispline/files/output_file.h"
#include "vispline/io/feature_writers.h"
#include "vispline/io/rig_document.h"
#include "vispline/io/write.h"
#include "vispline/simulate/feature_simulation.h"
#include "vispline/simulate/imu_simulation.h"

namespace vispline::cli {

/// mav0/NAME/data.csv, sensor.yaml, and the truth: poses, velocities and biases at the samples.
class ImuOutput {
 public:
  /// `is_reference`: the truth has the name that EuRoC gives it.
  ImuOutput(const std::string& folder, const Imu& imu, bool is_reference, OutputOptions options);
  void write(const SimulatedImu& block);
  void publish();

 private:
  ImuCsvWriter samples_;
  GroundTruthCsvWriter truth_;
};

/// tracks_NAME.csv or corners_NAME.csv, and truth/features_NAME.csv, truth/poses_NAME.csv.
class CameraOutput {
 public:
  /// `target_points`: number of points of a target; 0: tracks.
  CameraOutput(const std::string& folder, const Camera& camera, std::size_t target_points, OutputOptions options);
  void write(const SimulatedFrame& frame);
  void publish();

 private:
  Camera camera_;
  std::unique_ptr<TrackCsvWriter> tracks_;
  std::unique_ptr<CornerTableWriter> corners_;
  OutputFile features_truth_, poses_truth_;
};

/// The files of measurements and truth, in which a run could meet those of an older one.
std::vector<std::string> rig_output_paths(const std::string& folder, const Rig& rig, const SceneSource& scene);

/// landmarks.csv, target.yaml, kalibr/*.yaml; rig.yaml last: without it the set is not complete. Returns what the files
/// of Kalibr cannot hold.
std::vector<std::string> write_rig_files(const std::string& folder, const RigDocument& document,
                                         const SceneSource& scene, OutputOptions options);

}  // namespace vispline::cli
