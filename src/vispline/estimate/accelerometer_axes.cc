#include "vispline/estimate/accelerometer_axes.h"

#include <algorithm>
#include <array>

namespace vispline {
namespace {

constexpr double kMuchBetter = 0.25;  // of the squared distance

/// Medians: accelerations of poses are wild beside gaps.
struct Spread {
  Vector3d middle = Vector3d::Zero();
  double squared_distance = 0.0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Spread spread_of(const std::vector<FeltForce>& felt, const Matrix3d& axes) {
  std::vector<Vector3d> g_w;
  for (const FeltForce& f : felt) g_w.push_back(f.a_w - f.R_w_b * (axes * f.f_b));
  Spread spread;
  std::vector<double> values(felt.size());
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::transform(g_w.begin(), g_w.end(), values.begin(), [&](const Vector3d& g) { return g(k); });
    spread.middle(k) = median(values);
  }
  std::transform(g_w.begin(), g_w.end(), values.begin(),
                 [&](const Vector3d& g) { return (g - spread.middle).squaredNorm(); });
  spread.squared_distance = median(values);
  return spread;
}

std::string words_of(const Matrix3d& axes) {
  std::string words;
  for (Eigen::Index reading = 0; reading < 3; ++reading) {
    Eigen::Index axis = 0;
    axes.col(reading).cwiseAbs().maxCoeff(&axis);
    words += (words.empty() ? "" : ", ") + std::string(axes(axis, reading) < 0.0 ? "-" : "") + "xyz"[axis];
  }
  return words;
}

}  // namespace

AxesChoice accelerometer_axes(const std::vector<FeltForce>& felt) {
  AxesChoice choice;
  if (felt.empty()) return choice;
  const Spread as_read = spread_of(felt, choice.axes);
  choice.g_w = as_read.middle;
  double least = kMuchBetter * as_read.squared_distance;
  std::array<Eigen::Index, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d axes = Matrix3d::Zero();
      for (Eigen::Index i = 0; i < 3; ++i) axes(order[static_cast<std::size_t>(i)], i) = signs >> i & 1 ? -1.0 : 1.0;
      const double squared_distance = spread_of(felt, axes).squared_distance;
      if (squared_distance >= least) continue;
      least = squared_distance;
      choice.axes = axes;
      choice.words = words_of(axes);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return choice;
}

}  // namespace vispline
