#include "vispline/allan/noise_type.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vispline {
namespace {

/// Least-squares parabola taken off.
void remove_parabola(Eigen::VectorXd& z) {
  const Eigen::Index n = z.size();
  Eigen::MatrixX3d basis(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1.0;
    basis.row(i) << 1.0, t, t * t;
  }
  const Eigen::Vector3d fit = (basis.transpose() * basis).ldlt().solve(basis.transpose() * z);
  z -= basis * fit;
}

double lag_one_autocorrelation(const Eigen::VectorXd& z) {
  const Eigen::VectorXd centred = z.array() - z.mean();
  const Eigen::Index n = centred.size();
  return centred.head(n - 1).dot(centred.tail(n - 1)) / centred.squaredNorm();
}

}  // namespace

std::optional<int> noise_alpha(std::span<const double> phase, std::int64_t m) {
  std::vector<double> taken;
  for (std::size_t i = 0; i < phase.size(); i += static_cast<std::size_t>(m)) taken.push_back(phase[i]);
  if (static_cast<std::int64_t>(taken.size()) < kFewestForNoiseType) return std::nullopt;
  Eigen::VectorXd z = Eigen::Map<Eigen::VectorXd>(taken.data(), static_cast<Eigen::Index>(taken.size()));
  remove_parabola(z);
  for (int d = 0;; ++d) {
    const double r = lag_one_autocorrelation(z);
    const double delta = r / (1.0 + r);
    if (delta < 0.25 || d == 3) return std::clamp(2 - static_cast<int>(std::lround(2.0 * (delta + d))), -4, 2);
    z = (z.tail(z.size() - 1) - z.head(z.size() - 1)).eval();
  }
}

}  // namespace vispline
