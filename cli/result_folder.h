/// What calibrate and estimate leave on disk: documents always, a calibration only if it is to be trusted.
/// docs/formats.md, Results.
#pragma once

#include <string>
#include <vector>

#include "vispline/core/signal.h"
#include "vispline/estimate/state.h"
#include "vispline/files/output_file.h"
#include "vispline/io/euroc_groundtruth.h"
#include "vispline/io/rig_document.h"
#include "vispline/results/calibration_result.h"

namespace vispline::cli {

struct ResultFolder {
  std::string folder{};
  std::string name = "result";  ///< of the recording: NAME-camchain-imucam.yaml
  std::string json{};           ///< result.json
  std::string page{};           ///< report.html; empty: none
  RigDocument rig{};
  Signal<GroundTruth> course{};  ///< T_w_b, velocity and biases; empty: no trajectory files
};

/// Proves before a long run that the folder can be written.
void probe_result_folder(const std::string& folder, OutputOptions options);

/// The course of the body and the biases of its first IMU, `rate_hz` samples a second over the span of the curve.
Signal<GroundTruth> course_of(const State& state, double rate_hz);

/// trajectory.tum, trajectory.csv, rig.yaml, NAME-camchain-imucam.yaml, NAME-imu.yaml, report.html; result.json last.
/// Of a class that is not to be trusted only report.html, result.json and NAME.rejected.yaml, which says the class in
/// its first line. Returns what the files of Kalibr cannot hold.
std::vector<std::string> write_result_folder(const ResultFolder& output, const CalibrationResult& result,
                                             OutputOptions options);

}  // namespace vispline::cli
