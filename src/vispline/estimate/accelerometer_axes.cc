#include "vispline/estimate/accelerometer_axes.h"

#include <algorithm>
#include <array>

namespace vispline {
namespace {

constexpr double kMuchBetter = 0.25;  // of the variance

struct Spread {
  Vector3d mean = Vector3d::Zero();
  double variance = 0.0;
};

Spread spread_of(const std::vector<FeltForce>& felt, const Matrix3d& axes) {
  Spread spread;
  Vector3d square = Vector3d::Zero();
  for (const FeltForce& f : felt) {
    const Vector3d g_w = f.a_w - f.R_w_b * (axes * f.f_b);
    spread.mean += g_w / static_cast<double>(felt.size());
    square += g_w.cwiseAbs2() / static_cast<double>(felt.size());
  }
  spread.variance = (square - spread.mean.cwiseAbs2()).sum();
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
  choice.g_w = as_read.mean;
  double least = kMuchBetter * as_read.variance;
  std::array<Eigen::Index, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d axes = Matrix3d::Zero();
      for (Eigen::Index i = 0; i < 3; ++i) axes(order[static_cast<std::size_t>(i)], i) = signs >> i & 1 ? -1.0 : 1.0;
      const double variance = spread_of(felt, axes).variance;
      if (variance >= least) continue;
      least = variance;
      choice.axes = axes;
      choice.words = words_of(axes);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return choice;
}

}  // namespace vispline
