#include "signal_seeds.h"

#include "vispline/calibration/noise_files.h"
#include "vispline/calibration/rig_files.h"
#include "vispline/calibration/target_file.h"
#include "vispline/core/so3.h"
#include "vispline/io/euroc_imu.h"
#include "vispline/io/gyroflow.h"
#include "vispline/io/kitti.h"
#include "vispline/io/mocap.h"
#include "vispline/io/png.h"
#include "vispline/io/recorders_testing.h"
#include "vispline/io/tum.h"

namespace vispline::fuzz {
namespace {

using Seeds = std::vector<std::pair<std::string, std::string>>;

ImuSignal imu() {
  ImuSignal signal;
  for (int i = 0; i < 20; ++i) {
    signal.push_back(time_from_ns(1'520'530'308'000'000'001 + 5'000'000LL * i),
                     {Vector3d(0.1 * i, -0.2, 0.3), Vector3d(0.01 * i, 1.5, 9.7)});
  }
  return signal;
}

Signal<Pose> poses() {
  Signal<Pose> signal;
  for (int i = 0; i < 20; ++i) {
    signal.push_back(time_from_ns(1'520'530'308'000'000'001 + 100'000'000LL * i),
                     {SO3::exp<double>(Vector3d(0.1 * i, 0.2, -0.3)), Vector3d(0.5 * i, 1.0, -2.25)});
  }
  return signal;
}

void add_tables(Seeds& seeds) {
  std::string euroc = std::string(euroc_imu::kHeader) + "\n", plain = "t,gx [deg/s],gy,gz,ax [g],ay,az\n";
  const ImuSignal signal = imu();
  for (std::size_t i = 0; i < signal.size(); ++i) euroc_imu::append_row(euroc, signal.time[i], signal.value[i]);
  for (int i = 0; i < 12; ++i) plain += std::to_string(i) + "e-2;1,5;2;3;0;0;1\r\n";
  seeds.insert(seeds.end(), {{"text/euroc", euroc},
                             {"text/plain", plain},
                             {"text/gcsv", gyroflow::text(signal, 0.016)},
                             {"text/mocap", mocap::text(poses())},
                             {"text/tum", tum::text(poses())},
                             {"tum/seed", "# t tx ty tz qx qy qz qw\n" + tum::text(poses())},
                             {"kitti/seed", kitti::text(poses())}});
}

RigCalibration rig(const char* model, const char* distortion) {
  RigCalibration rig;
  rig.cameras.resize(1);
  CameraCalibration& camera = rig.cameras[0];
  camera.model = model;
  if (camera.model != "pinhole") camera.intrinsics = {0.3, 0.6};
  camera.intrinsics.insert(camera.intrinsics.end(), {460.0, 461.0, 320.0, 240.0});
  camera.distortion_model = distortion;
  if (camera.distortion_model != "none") camera.distortion = {0.1, 0.01, 0.001, 0.0002};
  camera.resolution_px = {640, 480};
  camera.T_cam_imu = Pose{SO3::exp<double>(Vector3d(1.0, 0.2, -0.3)), Vector3d(0.1, 0.2, 0.3)};
  camera.timeshift_cam_imu = 0.01;
  camera.line_delay = 3e-5;
  rig.imus.resize(1);
  rig.imus[0].noise = {.gyro_white = 1e-4,
                       .accel_white = 2e-3,
                       .gyro_walk = {.value = 1e-5},
                       .accel_walk = {.value = 3e-4},
                       .rate_hz = 200.0};
  return rig;
}

GreyImage image() {
  GreyImage image{9, 7};
  for (int i = 0; i < image.width * image.height; ++i) image.grey.push_back(static_cast<std::uint8_t>(11 * i));
  return image;
}

void add_parameters(Seeds& seeds) {
  for (const std::string& dialect : rig_dialects()) {
    const bool is_basalt = dialect == "basalt";
    int number = 0;
    for (const NamedText& file :
         rig_files(dialect, rig(is_basalt ? "ds" : "pinhole", is_basalt ? "none" : "equidistant"))) {
      seeds.emplace_back("config/" + dialect + std::to_string(number++), file.text);
    }
  }
  seeds.emplace_back("config/imu_utils", noise_file("imu_utils", rig("pinhole", "none").imus[0].noise).text);
  seeds.emplace_back("config/alias", "a: &x [1, 2]\nb: *x\nimu0: {update_rate: 200.0}\n");
}

}  // namespace

Seeds signal_seeds() {
  using namespace recorders_testing;
  Seeds seeds{{"gpmf/mp4", small_gopro_mp4()},
              {"gpmf/times", small_gopro_mp4(false, 2)},
              {"gpmf/bare", small_gopro_payload(0, false) + small_gopro_payload(1, true)},
              {"ulog/combined", combined_ulog()},
              {"png/seed", png_bytes(image())}};
  add_tables(seeds);
  add_parameters(seeds);
  return seeds;
}

}  // namespace vispline::fuzz
