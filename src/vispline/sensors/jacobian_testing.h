/// The shared test of every hand-written `linearize`: against dual numbers, and dual numbers against differences.
#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "vispline/core/random.h"
#include "vispline/sensors/retract.h"
#include "vispline/sensors/sensor.h"

namespace vispline::testing {

/// Where a sensor is linearized.
template <Sensor S>
struct Point {
  BodyState state;
  BodyTangent state_rate = BodyTangent::Zero();
  typename S::template Params<double> params;
  Vector3d g_w{0.0, 0.0, -9.81};
};

/// Columns of the state tangent, of all parameters, of g_w.
template <Sensor S>
inline constexpr int kInputs = body_tangent::kSize + S::kParams + 3;
template <Sensor S>
inline constexpr int kRows = S::Sample::RowsAtCompileTime;

/// predict() with every input moved by its part of delta; the time offset moves the state along its rate.
template <Sensor S, class T>
Eigen::Matrix<T, kRows<S>, 1> predict_moved(const Point<S>& at, const Eigen::Matrix<T, kInputs<S>, 1>& delta) {
  constexpr int kTime = tangent_offset(S::kBlocks, block_index(S::kBlocks, "time_offset"));
  const Eigen::Matrix<T, S::kParams, 1> d_params = delta.template segment<S::kParams>(body_tangent::kSize);
  const Vector3<T> d_g_w = delta.template tail<3>();
  Eigen::Matrix<T, body_tangent::kSize, 1> d_state = delta.template head<body_tangent::kSize>();
  d_state += at.state_rate.template cast<T>() * d_params[kTime];
  return S::template predict<T>(retract<T>(at.state, d_state), retract_params<S, T>(at.params, d_params),
                                at.g_w.template cast<T>() + d_g_w);
}

/// Columns with a name: the prediction itself, then its derivatives.
struct NamedColumns {
  Eigen::MatrixXd values;
  std::vector<std::pair<std::string, int>> groups;  ///< name, number of columns
};

template <Sensor S>
std::vector<std::pair<std::string, int>> column_groups() {
  std::vector<std::pair<std::string, int>> groups{{"prediction", 1}, {"position", 3}, {"rotation", 3},
                                                  {"velocity", 3},   {"omega", 3},    {"acceleration", 3},
                                                  {"alpha", 3}};
  for (const Block& block : S::kBlocks) groups.emplace_back(block.name, block.tangent_size());
  groups.emplace_back("g_w", 3);
  return groups;
}

template <LinearizedSensor S>
NamedColumns by_hand(const Point<S>& at) {
  const auto linear = S::linearize(at.state, at.state_rate, at.params, at.g_w);
  NamedColumns columns{Eigen::MatrixXd(kRows<S>, 1 + kInputs<S>), column_groups<S>()};
  columns.values << linear.prediction, linear.d_state, linear.d_params, linear.d_g_w;
  return columns;
}

template <Sensor S>
NamedColumns by_dual(const Point<S>& at) {
  using Dual = ceres::Jet<double, kInputs<S>>;
  Eigen::Matrix<Dual, kInputs<S>, 1> delta;
  for (int i = 0; i < kInputs<S>; ++i) delta[i] = Dual(0.0, i);
  const auto prediction = predict_moved<S, Dual>(at, delta);
  NamedColumns columns{Eigen::MatrixXd(kRows<S>, 1 + kInputs<S>), column_groups<S>()};
  for (int row = 0; row < kRows<S>; ++row) columns.values.row(row) << prediction[row].a, prediction[row].v.transpose();
  return columns;
}

/// Central differences with a step of 1e-5 in every input.
template <Sensor S>
NamedColumns by_difference(const Point<S>& at) {
  constexpr double kStep = 1e-5;
  using Delta = Eigen::Matrix<double, kInputs<S>, 1>;
  NamedColumns columns{Eigen::MatrixXd(kRows<S>, 1 + kInputs<S>), column_groups<S>()};
  columns.values.col(0) = predict_moved<S, double>(at, Delta::Zero());
  for (int i = 0; i < kInputs<S>; ++i) {
    const Delta step = kStep * Delta::Unit(i);
    columns.values.col(1 + i) =
        (predict_moved<S, double>(at, step) - predict_moved<S, double>(at, -step)) / (2 * kStep);
  }
  return columns;
}

struct WorstEntry {
  double relative_error = 0.0;  ///< |found - expected| / largest |expected| of its group of columns (1 if all are 0)
  std::string text = "all equal";
};

/// The entry with the largest relative error, by name; a NaN is the worst of all.
inline WorstEntry worst_entry(const NamedColumns& found, const NamedColumns& expected) {
  WorstEntry worst;
  int begin = 0;
  for (const auto& [name, width] : expected.groups) {
    const double largest = expected.values.middleCols(begin, width).cwiseAbs().maxCoeff();
    for (int row = 0; row < expected.values.rows(); ++row) {
      for (int col = begin; col < begin + width; ++col) {
        const double f = found.values(row, col), e = expected.values(row, col);
        const double error = std::abs(f - e) / (largest > 0.0 ? largest : 1.0);
        if (error <= worst.relative_error) continue;
        std::ostringstream text;
        text.precision(17);
        text << name << "[" << row << ", " << col - begin << "]: found " << f << ", expected " << e;
        worst = {std::isnan(error) ? HUGE_VAL : error, text.str()};
      }
    }
    begin += width;
  }
  return worst;
}

/// Numbers uniform in (-1, 1], one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : stream_(seed, "draw") {}
  double operator()() { return 2.0 * stream_.uniform_pair(index_++)[0] - 1.0; }
  template <int kSize>
  Eigen::Matrix<double, kSize, 1> vector(double largest) {
    return Eigen::Matrix<double, kSize, 1>::NullaryExpr([&](Eigen::Index) { return largest * (*this)(); });
  }

 private:
  RandomStream stream_;
  std::uint64_t index_ = 0;
};

/// Every input random and different; rotations by up to 2 sqrt(3) rad.
template <Sensor S>
Point<S> generic_point(std::uint64_t seed) {
  Draw draw(seed);
  Point<S> point;
  point.state = retract<double>(BodyState{}, draw.vector<body_tangent::kSize>(2.0));
  point.state_rate = draw.vector<body_tangent::kSize>(3.0);
  point.params = retract_params<S, double>({}, draw.vector<S::kParams>(0.7));
  point.g_w += draw.vector<3>(4.0);
  return point;
}

}  // namespace vispline::testing
