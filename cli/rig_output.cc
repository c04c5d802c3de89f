#include "rig_output.h"

#include <algorithm>

#include "vispline/calibration/rig_files.h"
#include "vispline/io/euroc_folder.h"
#include "vispline/io/format_words.h"
#include "vispline/io/mocap.h"
#include "vispline/io/rig_convert.h"
#include "vispline/io/rig_file.h"

namespace vispline::cli {
namespace {

std::string mav(const std::string& folder, const std::string& sensor) { return folder + "/mav0/" + sensor; }

std::string truth_name(const std::string& folder, const Imu& imu, bool is_reference) {
  return is_reference ? mav(folder, "state_groundtruth_estimate0/data.csv") : folder + "/truth/" + imu.name + ".csv";
}

std::string features_name(const std::string& folder, const Camera& camera, bool is_target) {
  return folder + (is_target ? "/corners_" : "/tracks_") + camera.name + ".csv";
}

std::string truth_row(Time stamp, const Feature& feature, const FeatureTruth& truth) {
  std::string row;
  append_number(row, to_ns(stamp));
  row += ',' + std::to_string(feature.id) + ',' + std::to_string(truth.landmark);
  append_cells(row, ',', truth.exact_px);
  append_cells(row, ',', Vector2d(truth.line_s, truth.is_outlier ? 1.0 : 0.0));
  return row + '\n';
}

void write_target(const std::string& folder, const SceneSource& source, OutputOptions options) {
  const NamedText file = target_file("kalibr", *source.target);
  write_file(folder + "/" + file.file_name, file.text, options);
  PointMap points_t;
  const Pose T_t_w = source.T_w_t.inverse();
  for (const SceneLandmark& landmark : source.scene.landmarks) points_t[landmark.id] = T_t_w * landmark.point_w;
  write_points(folder + "/target_points.csv", points_t, options);
}

/// Without IMUs if one of them is exact: Kalibr divides by the noise.
RigCalibration kalibr_rig(const Rig& rig, std::vector<std::string>& notes) {
  RigCalibration calibration = calibration_of(rig, notes);
  const bool is_exact = std::ranges::any_of(
      rig.imus, [](const Imu& imu) { return imu.noise.gyro.white == 0.0 || imu.noise.accel.white == 0.0; });
  if (!is_exact) return calibration;
  calibration.imus.clear();
  notes.emplace_back("an IMU has no white noise, which Kalibr cannot take: its IMU files are left out");
  return calibration;
}

}  // namespace

ImuOutput::ImuOutput(const std::string& folder, const Imu& imu, bool is_reference, OutputOptions options)
    : samples_(mav(folder, imu.name) + "/data.csv", options), truth_(truth_name(folder, imu, is_reference), options) {
  write_file(mav(folder, imu.name) + "/sensor.yaml", euroc_folder::imu_yaml(imu), options);
}

void ImuOutput::write(const SimulatedImu& block) {
  samples_.write(block.measured);
  for (std::size_t i = 0; i < block.body.size(); ++i) {
    const BodyState& state = block.body.value[i];
    truth_.write(block.body.time[i], {state.T_w_b(), state.v_w, block.bias[i].gyro, block.bias[i].accel});
  }
}

void ImuOutput::publish() {
  samples_.publish();
  truth_.publish();
}

CameraOutput::CameraOutput(const std::string& folder, const Camera& camera, std::size_t target_points,
                           OutputOptions options)
    : camera_(camera),
      features_truth_(folder + "/truth/features_" + camera.name + ".csv", options),
      poses_truth_(folder + "/truth/poses_" + camera.name + ".csv", options) {
  if (target_points > 0) {
    corners_ = std::make_unique<CornerTableWriter>(features_name(folder, camera, true), target_points, options);
  } else {
    tracks_ = std::make_unique<TrackCsvWriter>(features_name(folder, camera, false), options);
  }
  features_truth_.write("#timestamp [ns],id,landmark,u_exact [px],v_exact [px],line [s],outlier\n");
  poses_truth_.write(std::string(mocap::kHeader) + '\n');
}

void CameraOutput::write(const SimulatedFrame& frame) {
  const Time stamp = frame.instant.stamp;
  if (corners_) corners_->write(stamp, frame.features);
  if (tracks_) tracks_->write(stamp, frame.features);
  std::string rows, pose;
  for (std::size_t i = 0; i < frame.features.size(); ++i) rows += truth_row(stamp, frame.features[i], frame.truth[i]);
  features_truth_.write(rows);
  mocap::append_pose(pose, stamp, frame.body.T_w_b() * camera_.T_c_b.inverse());
  poses_truth_.write(pose + '\n');
}

void CameraOutput::publish() {
  if (corners_) corners_->publish();
  if (tracks_) tracks_->publish();
  features_truth_.publish();
  poses_truth_.publish();
}

std::vector<std::string> rig_output_paths(const std::string& folder, const Rig& rig, const SceneSource& scene) {
  std::vector<std::string> paths = {folder + "/landmarks.csv"};
  for (std::size_t i = 0; i < rig.imus.size(); ++i) {
    paths.push_back(mav(folder, rig.imus[i].name) + "/data.csv");
    paths.push_back(truth_name(folder, rig.imus[i], i == 0));
  }
  for (const Camera& camera : rig.cameras) {
    paths.push_back(mav(folder, camera.name) + "/data.csv");
    paths.push_back(features_name(folder, camera, scene.target.has_value()));
    paths.push_back(folder + "/truth/features_" + camera.name + ".csv");
    paths.push_back(folder + "/truth/poses_" + camera.name + ".csv");
  }
  return paths;
}

std::vector<std::string> write_rig_files(const std::string& folder, const RigDocument& document,
                                         const SceneSource& scene, OutputOptions options) {
  PointMap points_w;
  for (const SceneLandmark& landmark : scene.scene.landmarks) points_w[landmark.id] = landmark.point_w;
  if (!points_w.empty()) write_points(folder + "/landmarks.csv", points_w, options);
  if (scene.target) write_target(folder, scene, options);
  for (const Camera& camera : document.rig.cameras) {
    write_file(mav(folder, camera.name) + "/sensor.yaml", euroc_folder::camera_yaml(camera), options);
  }
  std::vector<std::string> notes;
  for (const NamedText& file : rig_files("kalibr", kalibr_rig(document.rig, notes))) {
    write_file(folder + "/kalibr/" + file.file_name, file.text, options);
  }
  write_rig(folder + "/rig.yaml", document, options);
  return notes;
}

}  // namespace vispline::cli
