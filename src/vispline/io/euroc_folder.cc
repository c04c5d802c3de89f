#include "vispline/io/euroc_folder.h"

#include "vispline/calibration/dialect_text.h"
#include "vispline/calibration/rig_text.h"
#include "vispline/io/rig_convert.h"

namespace vispline::euroc_folder {
using namespace dialect;
namespace {

std::string head(const std::string& type, const std::string& name, const Pose& T_b_s) {
  std::string text = "%YAML:1.0\nsensor_type: " + type + "\ncomment: " + yaml_string(name) + "\n";
  text += "T_BS:\n  cols: 4\n  rows: 4\n  data: [";
  const Eigen::MatrixXd matrix = matrix4(T_b_s);
  for (Eigen::Index i = 0; i < 16; ++i) text += (i ? ", " : "") + yaml_float(matrix(i / 4, i % 4));
  return text + "]\n";
}

}  // namespace

std::string imu_yaml(const Imu& imu) {
  return head("imu", imu.name, imu.accelerometer.T_b_i) + value_line("", "rate_hz", yaml_float(imu.rate_hz), "") +
         value_line("", "gyroscope_noise_density", yaml_float(imu.noise.gyro.white), "rad/s/sqrt(Hz)") +
         value_line("", "gyroscope_random_walk", yaml_float(imu.noise.gyro.walk), "rad/s^2/sqrt(Hz)") +
         value_line("", "accelerometer_noise_density", yaml_float(imu.noise.accel.white), "m/s^2/sqrt(Hz)") +
         value_line("", "accelerometer_random_walk", yaml_float(imu.noise.accel.walk), "m/s^3/sqrt(Hz)");
}

std::string camera_yaml(const Camera& camera) {
  const auto [model, distortion] = lens_words(camera.lens.model);
  const bool is_radtan = distortion == "radtan";
  const LensParams& params = camera.lens.params;
  const double* const split = params.data() + (model == "pinhole" ? 4 : model == "omni" ? 5 : 6);
  return head("camera", camera.name, camera.T_c_b.inverse()) +
         value_line("", "rate_hz", yaml_float(camera.rate_hz), "") + "resolution: [" +
         std::to_string(camera.resolution_px[0]) + ", " + std::to_string(camera.resolution_px[1]) + "]\n" +
         value_line("", "camera_model", std::string(model), "") +
         value_line("", "intrinsics", list({params.data(), split}), "fu, fv, cu, cv last") +
         value_line("", "distortion_model", is_radtan ? "radial-tangential" : std::string(distortion), "") +
         value_line("", "distortion_coefficients", list({split, params.data() + params.size()}), "");
}

std::string image_name(Time stamp) { return std::to_string(to_ns(stamp)) + ".png"; }

std::string image_row(Time stamp) { return std::to_string(to_ns(stamp)) + "," + image_name(stamp) + "\n"; }

}  // namespace vispline::euroc_folder
