#include "vispline/results/dead_reckoning_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"
#include "vispline/results/gaps.h"

namespace vispline {
namespace {

void add(DeadReckoningError& error, double& sum_of_squares, const Pose& T_w_b, const BodyState& truth) {
  error.final_error_m = (T_w_b.p - truth.p_w).norm();
  error.max_error_m = std::max(error.max_error_m, error.final_error_m);
  sum_of_squares += error.final_error_m * error.final_error_m;
  const double angle = SO3::log<double>(truth.R_w_b.transpose() * T_w_b.R).norm();
  error.attitude_error_deg = std::max(error.attitude_error_deg, angle * 180.0 / std::numbers::pi);
  ++error.samples;
}

/// The row of the same method with the highest rate below that of `row`; null at the lowest.
const IntegrationRow* next_lower(const std::vector<IntegrationRow>& rows, const IntegrationRow& row) {
  const IntegrationRow* lower = nullptr;
  for (const IntegrationRow& other : rows) {
    if (other.method != row.method || other.rate_hz >= row.rate_hz) continue;
    if (lower == nullptr || other.rate_hz > lower->rate_hz) lower = &other;
  }
  return lower;
}

}  // namespace

DeadReckoningError dead_reckoning_error(const Signal<Pose>& T_w_b, const Trajectory& truth) {
  require(!T_w_b.empty(), "at least one integrated pose");
  DeadReckoningError error;
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < T_w_b.size(); ++i) {
    const std::optional<BodyState> state = truth.at(T_w_b.time[i]);
    if (state) {
      add(error, sum_of_squares, T_w_b.value[i], *state);
    } else {
      ++error.outside;
    }
  }
  if (error.samples == 0) {
    throw_no_overlap("the integration", T_w_b.span(), "the trajectory", truth.span(),
                     "integrate inside the span of the trajectory");
  }
  error.rmse_m = std::sqrt(sum_of_squares / static_cast<double>(error.samples));
  return error;
}

void fill_observed_orders(std::vector<IntegrationRow>& rows) {
  for (IntegrationRow& row : rows) {
    row.order.reset();
    const IntegrationRow* lower = next_lower(rows, row);
    if (lower == nullptr) continue;
    const double order =
        std::log(lower->error.max_error_m / row.error.max_error_m) / std::log(row.rate_hz / lower->rate_hz);
    if (std::isfinite(order)) row.order = order;
  }
}

}  // namespace vispline
