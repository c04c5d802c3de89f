#include "vispline/sensors/imu.h"

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

[[noreturn]] void fail(const Imu& imu, std::string_view field, std::string_view expected) {
  throw Error(ExitCode::kUsage,
              {.code = "E-CONFIG",
               .message = "IMU " + quoted(imu.name) + ": " + std::string(field) + " must be " + std::string(expected),
               .where = "",
               .effect = "nothing done",
               .next = "correct this value of the IMU"});
}

bool is_finite(double x) { return std::isfinite(x); }
bool is_finite(const Pose& pose) { return pose.R.allFinite() && pose.p.allFinite(); }
template <int kRows, int kCols>
bool is_finite(const Eigen::Matrix<double, kRows, kCols>& x) {
  return x.allFinite();
}

template <Sensor Model>
void check_params(const Imu& imu, const typename Model::template Params<double>& params) {
  const auto blocks = params.tie();
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((is_finite(std::get<i>(blocks)) ||
      (fail(imu, std::string(Model::kName) + " " + std::string(Model::kBlocks[i].name), "finite"), true)),
     ...);
  }
  (std::make_index_sequence<Model::kBlocks.size()>());
}

void check_noise(const Imu& imu, std::string_view triad, const NoiseModel& noise) {
  const std::pair<std::string_view, double> fields[] = {
      {"white", noise.white},
      {"walk", noise.walk},
      {"bias_instability", noise.bias_instability},
      {"turn_on_bias", noise.turn_on_bias},
      {"quantum", noise.quantum},
      {"range", noise.range},
  };
  for (const auto& [name, value] : fields) {
    if (!(std::isfinite(value) && value >= 0.0)) {
      fail(imu, std::string(triad) + " noise " + std::string(name), "finite and not negative");
    }
  }
}

}  // namespace

void require_valid(const Imu& imu) {
  if (imu.name.empty()) fail(imu, "name", "not empty");
  if (!(std::isfinite(imu.rate_hz) && imu.rate_hz > 0.0)) fail(imu, "rate_hz", "finite and positive");
  check_params<Gyroscope>(imu, imu.gyroscope);
  check_params<Accelerometer>(imu, imu.accelerometer);
  check_noise(imu, Gyroscope::kName, imu.noise.gyro);
  check_noise(imu, Accelerometer::kName, imu.noise.accel);
}

}  // namespace vispline
