#include "vispline/allan/imu_utils.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

namespace vispline {
namespace {

constexpr int kClusters = 100;
constexpr Eigen::Index kCoefficients = 5;
/// Where its search for the minimum starts, in its own units: larger minima are printed as this.
constexpr double kCeiling = 1000.0;
/// Its factor from rad/s to deg/h.
constexpr double kDegPerHour = 57.3 * 3600.0;

using Coefficients = Eigen::VectorXd;

/// Variance of the model: a_0^2 / tau^2 + a_1^2 / tau + a_2^2 + a_3^2 tau + a_4^2 tau^2.
double model(const Coefficients& a, double tau) {
  double sum = 0.0, power = 1.0 / (tau * tau);
  for (Eigen::Index i = 0; i < kCoefficients; ++i, power *= tau) sum += a(i) * a(i) * power;
  return sum;
}

/// Residuals log10(model) - log10(data), for Eigen's Levenberg-Marquardt.
struct LogResiduals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  std::span<const double> tau, variance;

  int inputs() const { return static_cast<int>(kCoefficients); }
  int values() const { return static_cast<int>(std::max<std::size_t>(tau.size(), kCoefficients)); }
  int operator()(const InputType& a, ValueType& residual) const {
    residual.setZero(values());
    for (std::size_t i = 0; i < tau.size(); ++i) {
      residual(static_cast<Eigen::Index>(i)) = std::log10(model(a, tau[i])) - std::log10(variance[i]);
    }
    return 0;
  }
  int df(const InputType& a, JacobianType& jacobian) const {
    jacobian.setZero(values(), kCoefficients);
    for (std::size_t i = 0; i < tau.size(); ++i) {
      const double scale = 2.0 / (std::log(10.0) * model(a, tau[i]));
      double power = 1.0 / (tau[i] * tau[i]);
      for (Eigen::Index k = 0; k < kCoefficients; ++k, power *= tau[i]) {
        jacobian(static_cast<Eigen::Index>(i), k) = scale * a(k) * power;
      }
    }
    return 0;
  }
};

/// Least squares of the deviation itself on tau^-1 .. tau^1, signs dropped.
Coefficients start(std::span<const double> tau, std::span<const double> variance) {
  const auto n = static_cast<Eigen::Index>(tau.size());
  Eigen::MatrixXd basis(n, kCoefficients);
  Eigen::VectorXd deviation(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = tau[static_cast<std::size_t>(i)];
    basis.row(i) << 1.0 / t, 1.0 / std::sqrt(t), 1.0, std::sqrt(t), t;
    deviation(i) = std::sqrt(variance[static_cast<std::size_t>(i)]);
  }
  return basis.colPivHouseholderQr().solve(deviation).cwiseAbs();
}

}  // namespace

std::vector<std::int64_t> imu_utils_factors(std::int64_t readings) {
  std::vector<std::int64_t> factors;
  if (readings < 4) return factors;
  const double largest = std::exp2(std::floor(std::log2(static_cast<double>(readings) / 2.0)));
  const double step = std::log10(largest) / (kClusters - 1);
  for (int i = 0; i < kClusters; ++i) {
    // Rounded up, but not over a whole number by the rounding of the power.
    const auto m = static_cast<std::int64_t>(std::ceil(std::pow(10.0, step * i) - 1e-9));
    if (factors.empty() || m != factors.back()) factors.push_back(m);
  }
  return factors;
}

ImuUtilsNumbers imu_utils_numbers(std::span<const std::int64_t> factors, std::span<const double> deviation,
                                  double rate_hz, std::string_view unit) {
  const double scale = unit == "rad/s" ? kDegPerHour : 1.0;
  ImuUtilsNumbers numbers;
  std::vector<double> variance;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (!(deviation[i] > 0.0)) continue;
    numbers.tau_s.push_back(static_cast<double>(factors[i]) / rate_hz);
    variance.push_back(deviation[i] * deviation[i] * scale * scale);
  }
  std::size_t first = 0;  // the accelerometer's fit leaves out a rise below one second
  if (unit != "rad/s") {
    while (first + 1 < variance.size() && numbers.tau_s[first] < 1.0 && variance[first + 1] > variance[first]) ++first;
  }
  const std::span<const double> tau = std::span(numbers.tau_s).subspan(std::min(first, numbers.tau_s.size()));
  if (tau.size() < static_cast<std::size_t>(kCoefficients)) return numbers;
  LogResiduals residuals{tau, std::span(variance).subspan(first)};
  Coefficients a = start(residuals.tau, residuals.variance);
  Eigen::LevenbergMarquardt<LogResiduals> solver(residuals);
  solver.minimize(a);

  double least = kCeiling * kCeiling;
  for (std::size_t i = 0; i < numbers.tau_s.size(); ++i) {
    const double fitted = model(a, numbers.tau_s[i]);
    numbers.measured.push_back(std::sqrt(variance[i]) / scale);
    numbers.fitted.push_back(std::sqrt(fitted) / scale);
    if (i < first || fitted >= least) continue;
    least = fitted;
    numbers.w_tau_s = numbers.tau_s[i];
  }
  numbers.w = std::sqrt(least) / scale;
  numbers.n = std::sqrt(rate_hz * model(a, 1.0)) / scale;
  return numbers;
}

}  // namespace vispline
