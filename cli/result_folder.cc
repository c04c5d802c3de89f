#include "result_folder.h"

#include <algorithm>
#include <cmath>

#include "vispline/calibration/rig_files.h"
#include "vispline/io/rig_convert.h"
#include "vispline/io/rig_yaml.h"
#include "vispline/io/write.h"
#include "vispline/results/calibration_comment.h"

namespace vispline::cli {
namespace {

/// Kalibr's own names for the files of its results; its noise file is an input.
std::string kalibr_name(const std::string& name, const std::string& file) {
  if (file == "camchain.yaml") return name + "-camchain-imucam.yaml";
  return file == "imu-chain.yaml" ? name + "-imu.yaml" : "";
}

std::vector<std::string> names_of(const auto& sensors) {
  std::vector<std::string> names;
  for (const auto& sensor : sensors) names.push_back(sensor.name);
  return names;
}

/// Kalibr divides by the noise: without it, no file of the IMU.
RigCalibration kalibr_rig(const Rig& rig, std::vector<std::string>& notes) {
  RigCalibration calibration = calibration_of(rig, notes);
  const bool exact = std::ranges::any_of(
      rig.imus, [](const Imu& imu) { return imu.noise.gyro.white == 0.0 || imu.noise.accel.white == 0.0; });
  if (exact) calibration.imus.clear();
  return calibration;
}

std::vector<std::string> write_kalibr(const ResultFolder& output, const CalibrationResult& result,
                                      OutputOptions options) {
  std::vector<std::string> notes;
  if (output.rig.rig.cameras.empty()) return notes;
  for (const NamedText& file : rig_files("kalibr", kalibr_rig(output.rig.rig, notes))) {
    const std::string name = kalibr_name(output.name, file.file_name);
    if (name.empty()) continue;
    const bool cameras = file.file_name == "camchain.yaml";
    const std::string comment =
        calibration_comment(result, cameras ? names_of(output.rig.rig.cameras) : names_of(output.rig.rig.imus));
    write_file(output.folder + "/" + name, comment + file.text, options);
    if (cameras) notes.insert(notes.end(), file.notes.begin(), file.notes.end());
  }
  return notes;
}

void write_course(const ResultFolder& output, OutputOptions options) {
  if (output.course.size() == 0) return;
  Signal<Pose> poses;
  for (std::size_t i = 0; i < output.course.size(); ++i) {
    poses.push_back(output.course.time[i], output.course.value[i].T_w_b);
  }
  write_trajectory_tum(output.folder + "/trajectory.tum", poses, options);
  write_groundtruth_euroc(output.folder + "/trajectory.csv", output.course, options);
}

bool is_finite(const Rig& rig) {
  try {
    require_valid(rig);
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace

void probe_result_folder(const std::string& folder, OutputOptions options) {
  constexpr std::uint64_t kBytes = 10'000'000;
  probe_output(folder + "/result.json", kBytes, options);
}

Signal<GroundTruth> course_of(const State& state, double rate_hz) {
  Signal<GroundTruth> course;
  const TimeSpan span = state.curve->span();
  const auto samples = static_cast<std::int64_t>(std::floor(span.seconds() * rate_hz));
  for (std::int64_t k = 0; k <= samples; ++k) {
    const Time time = span.begin + from_seconds(static_cast<double>(k) / rate_hz);
    if (time > span.end) break;
    const BodyState body = state.curve->state({time});
    Vector6d bias = Vector6d::Zero();
    if (!state.rig.imus.empty()) {
      bias << state.rig.imus[0].gyroscope.bias, state.rig.imus[0].accelerometer.bias;
      if (!state.bias_walks.empty()) bias += state.bias_walks[0].at({time});
    }
    course.push_back(time, {body.T_w_b(), body.v_w, bias.head<3>(), bias.tail<3>()});
  }
  return course;
}

std::vector<std::string> write_result_folder(const ResultFolder& output, const CalibrationResult& result,
                                             OutputOptions options) {
  std::vector<std::string> notes;
  const std::string comment = calibration_comment(result);
  if (is_trusted(result.result_class)) {
    write_course(output, options);
    notes = write_kalibr(output, result, options);
    write_file(output.folder + "/rig.yaml", comment + rig_yaml::text(output.rig), options);
  } else {
    const std::string rig = is_finite(output.rig.rig) ? rig_yaml::text(output.rig) : "";
    write_file(output.folder + "/" + output.name + ".rejected.yaml", comment + rig, options);
  }
  if (!output.page.empty()) write_file(output.folder + "/report.html", output.page, options);
  write_file(output.folder + "/result.json", output.json, options);
  return notes;
}

}  // namespace vispline::cli
