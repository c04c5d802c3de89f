#include "vispline/results/imu_refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vispline/core/so3.h"
#include "vispline/results/gaps.h"

namespace vispline {
namespace {

constexpr double kSlopeWindow = 0.05;          // s, half width of the window of the slope
constexpr std::size_t kMaxSlopeSamples = 50;   // on either side
constexpr double kMinSecondCorrelation = 0.3;  // of the rates across the main axis of rotation
constexpr double kMinSecondVariance = 1e-10;   // of the variance along the main axis
constexpr double kConverged = 1e-10;           // s and rad
constexpr int kMaxIterations = 30, kMaxRestarts = 10;

/// Parameters: lag (0), bias (1-3), rotation (4-6).
constexpr int kLag = 0, kBias = 1, kRotation = 4, kSize = 7, kSizeWithoutRotation = 4;
using Equations = Eigen::Matrix<double, 3, kSize>;

/// A sample of the second signal.
struct Rate {
  double seconds;
  Vector3d omega;
  Vector3d slope;  ///< rad/s^2
};

/// Slope of the line through the samples around i: their errors enter it with odd weights, that of i itself with none.
Vector3d slope_at(const ImuSignal& imu, std::size_t i, std::size_t half) {
  const std::size_t n = std::min({half, i, imu.size() - 1 - i});
  Vector3d sum = Vector3d::Zero();
  double squares = 0.0;
  for (std::size_t k = 1; k <= n; ++k) {
    const double width = to_seconds(imu.time[i + k] - imu.time[i - k]);
    sum += width * (imu.value[i + k].gyro - imu.value[i - k].gyro);
    squares += width * width;
  }
  return n == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(sum / squares);
}

std::vector<Rate> rates_of(const ImuSignal& imu) {
  const double samples = kSlopeWindow / median_period_s(imu.time);
  const auto half = static_cast<std::size_t>(std::clamp(samples, 1.0, static_cast<double>(kMaxSlopeSamples)));
  std::vector<Rate> rates;
  for (std::size_t i = 0; i < imu.size(); ++i) {
    rates.push_back({to_seconds(imu.time[i] - imu.time[0]), imu.value[i].gyro, slope_at(imu, i, half)});
  }
  return rates;
}

/// The samples that stay inside a stretch of the first signal while the lag moves by up to margin_s.
std::vector<Rate> usable(const ImuSpline& first, const std::vector<Rate>& rates, double lag_s, double margin_s) {
  std::vector<Rate> kept;
  for (const Rate& rate : rates) {
    const double seconds = rate.seconds - lag_s;
    if (first.covers(seconds - margin_s, seconds + margin_s)) kept.push_back(rate);
  }
  return kept;
}

struct Covariances {
  Matrix3d first = Matrix3d::Zero(), second = Matrix3d::Zero();
  Matrix3d cross = Matrix3d::Zero();  ///< second by first
};

Covariances covariances(const ImuSpline& first, const std::vector<Rate>& rates, double lag_s) {
  const auto omega_first = [&](const Rate& rate) -> Vector3d {
    const double seconds = rate.seconds - lag_s;
    return first.value(*first.interval(seconds), seconds).head<3>();
  };
  Vector3d mean_first = Vector3d::Zero(), mean_second = Vector3d::Zero();
  for (const Rate& rate : rates) {
    mean_first += omega_first(rate) / static_cast<double>(rates.size());
    mean_second += rate.omega / static_cast<double>(rates.size());
  }
  Covariances c;
  for (const Rate& rate : rates) {
    const Vector3d a = omega_first(rate) - mean_first, b = rate.omega - mean_second;
    c.first += a * a.transpose();
    c.second += b * b.transpose();
    c.cross += b * a.transpose();
  }
  return c;
}

/// The second largest variance over all directions.
double second_variance(const Matrix3d& covariance) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(covariance, Eigen::EigenvaluesOnly).eigenvalues()(1);
}

bool has_two_axes(const Covariances& c, const Vector3d& singular) {
  const double variance = std::sqrt(std::max(0.0, second_variance(c.first) * second_variance(c.second)));
  return variance > kMinSecondVariance * singular(0) && singular(1) > kMinSecondCorrelation * variance;
}

/// Kabsch's rotation; about one axis only, the smallest rotation that maps axis to axis.   docs/math/evaluate.md (21)
void fit_rotation(const Covariances& c, ImuRefinement& fit) {
  const Eigen::JacobiSVD<Matrix3d> svd(c.cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d &U = svd.matrixU(), &V = svd.matrixV();
  fit.rotation_observable = has_two_axes(c, svd.singularValues());
  if (fit.rotation_observable) {
    const double sign = U.determinant() * V.determinant() < 0.0 ? -1.0 : 1.0;
    fit.R_second_first = U * Vector3d(1.0, 1.0, sign).asDiagonal() * V.transpose();
  } else {
    fit.R_second_first = Eigen::Quaterniond::FromTwoVectors(V.col(0), U.col(0)).toRotationMatrix();
  }
}

Equations equations(const Vector3d& slope, const Vector3d& omega) {
  Equations rows;
  rows.col(kLag) = slope;
  rows.middleCols<3>(kBias) = -Matrix3d::Identity();
  rows.middleCols<3>(kRotation) = hat(omega);
  return rows;
}

/// One Newton step for (lag, bias, rotation): (sum Z^T J) step = -sum Z^T r.   docs/math/evaluate.md (23)
Eigen::VectorXd newton_step(const ImuSpline& first, const std::vector<Rate>& rates, const ImuRefinement& fit) {
  Eigen::Matrix<double, kSize, kSize> A = Eigen::Matrix<double, kSize, kSize>::Zero();
  Eigen::Matrix<double, kSize, 1> b = Eigen::Matrix<double, kSize, 1>::Zero();
  for (const Rate& rate : rates) {
    const double seconds = rate.seconds - fit.lag_s;
    const std::size_t interval = *first.interval(seconds);
    const Vector3d omega = fit.R_second_first * first.value(interval, seconds).head<3>();
    const Vector3d slope = fit.R_second_first * first.rate(interval, seconds).head<3>();
    const Equations Z = equations(rate.slope, rate.omega - fit.bias);
    A.noalias() += Z.transpose() * equations(slope, omega);
    b.noalias() -= Z.transpose() * (rate.omega - fit.bias - omega);
  }
  const int n = fit.rotation_observable ? kSize : kSizeWithoutRotation;
  return A.topLeftCorner(n, n).fullPivLu().solve(b.head(n));
}

enum class Outcome { kDone, kLeftMargin, kFailed };

Outcome iterate(const ImuSpline& first, const std::vector<Rate>& rates, double margin_s, ImuRefinement& fit) {
  const double centre_s = fit.lag_s;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::VectorXd step = newton_step(first, rates, fit);
    if (!step.allFinite()) return Outcome::kFailed;
    fit.bias += step.segment<3>(kBias);
    double turn = 0.0;
    if (fit.rotation_observable) {
      fit.R_second_first = SO3::exp<double>(step.segment<3>(kRotation)) * fit.R_second_first;
      turn = step.segment<3>(kRotation).norm();
    }
    const double lag_s = fit.lag_s + step(kLag);
    fit.lag_s = std::clamp(lag_s, centre_s - margin_s, centre_s + margin_s);
    if (lag_s != fit.lag_s) return Outcome::kLeftMargin;
    if (std::abs(step(kLag)) < kConverged && turn < kConverged) return Outcome::kDone;
  }
  return Outcome::kFailed;
}

}  // namespace

ImuRefinement refine_alignment(const ImuSpline& first, const ImuSignal& second, double start_lag_s, double margin_s) {
  const std::vector<Rate> rates = rates_of(second);
  ImuRefinement fit{.lag_s = start_lag_s};
  for (int restart = 0; restart < kMaxRestarts; ++restart) {
    const std::vector<Rate> kept = usable(first, rates, fit.lag_s, margin_s);
    if (kept.size() < kSize) break;
    fit_rotation(covariances(first, kept, fit.lag_s), fit);
    const Outcome outcome = iterate(first, kept, margin_s, fit);
    fit.converged = outcome == Outcome::kDone;
    if (outcome != Outcome::kLeftMargin) break;
  }
  if (!fit.converged) fit.lag_s = start_lag_s;
  return fit;
}

}  // namespace vispline
