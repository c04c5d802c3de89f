// A new sensor in one struct: a magnetometer on the body. docs/extending.md, "A sensor".
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "vispline/sensors/retract.h"
#include "vispline/sensors/sensor.h"
#include "vispline/trajectory/analytic.h"

using namespace vispline;

/// Three-axis magnetometer in a field that is the same everywhere.
struct Magnetometer {
  static constexpr std::string_view kName = "magnetometer";
  using Sample = Vector3d;  ///< uT in frame m

  template <class T>
  struct Params {
    PoseT<T> T_b_m;                                        ///< pose of the instrument in the body
    Vector3<T> field_w = Vector3<T>(T(0), T(20), T(-45));  ///< uT
    Vector3<T> bias = Vector3<T>::Zero();                  ///< hard iron, uT

    auto tie() { return std::tie(T_b_m, field_w, bias); }
    auto tie() const { return std::tie(T_b_m, field_w, bias); }
  };

  static constexpr std::array<Block, 3> kBlocks{{{"T_b_m", 12, Space::kSE3, "m, rad"},
                                                 {"field", 3, Space::kEuclidean, "uT"},
                                                 {"bias", 3, Space::kEuclidean, "uT"}}};
  static constexpr int kParams = tangent_offset(kBlocks, kBlocks.size());

  /// m_m = R_m_b R_b_w field_w + bias, uT in frame m. A magnetometer does not feel gravity. Never fails.
  template <class T>
  static Vector3<T> predict(const BodyStateT<T>& state, const Params<T>& params, const Vector3<T>& /*g_w*/) {
    return params.T_b_m.R.transpose() * (state.R_w_b.transpose() * params.field_w) + params.bias;
  }
};

// Says which requirement is not met, if one is not.
static_assert(Sensor<Magnetometer>);

int main() {
  const Time start{};
  const Trajectory trajectory = analytic_trajectory("dance", start, std::chrono::seconds(10)).value();
  const Vector3d g_w(0, 0, -9.81);

  // Calibration that differs from the default: turned by 0.1 rad about x, 3 uT of hard iron.
  Eigen::Matrix<double, Magnetometer::kParams, 1> change = Eigen::Matrix<double, Magnetometer::kParams, 1>::Zero();
  change[3] = 0.1;
  change[tangent_offset(Magnetometer::kBlocks, block_index(Magnetometer::kBlocks, "bias"))] = 3.0;
  const auto params = retract_params<Magnetometer, double>({}, change);

  double worst_error = 0.0;
  for (const double t : {0.0, 2.5, 5.0, 7.5}) {
    const BodyState state = *trajectory.at(start + from_seconds(t));
    const Vector3d m = Magnetometer::predict<double>(state, params, g_w);
    std::printf("t %4.1f s   m = (%7.3f, %7.3f, %7.3f) uT\n", t, m.x(), m.y(), m.z());
    // However the body turns, without the bias the field keeps its length.
    worst_error = std::max(worst_error, std::abs((m - params.bias).norm() - params.field_w.norm()));
  }
  return worst_error < 1e-12 ? 0 : 1;
}
