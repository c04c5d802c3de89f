#include "vispline/estimate/priors.h"

#include <algorithm>
#include <cmath>

namespace vispline {
namespace {

void square(Rows& rows) { rows.cost = 0.5 * rows.r.squaredNorm(); }

class PriorRows final : public Measurement {
 public:
  PriorRows(const State& start, const Parameter& parameter) : start_(start), parameter_(parameter) {}

  std::vector<std::string> sensors() const override { return {"prior." + parameter_.name}; }
  Time time() const override { return {}; }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    rows.start(parameter_.size);
    rows.r = parameter_.delta(start_, state) / parameter_.treatment.sigma;
    square(rows);
    if (!derivatives) return;
    rows.append(columns.parameters.by_name.at(parameter_.name), parameter_.size);
    rows.allocate_jacobian();
    rows.J.diagonal().setConstant(1.0 / parameter_.treatment.sigma);
  }

 private:
  State start_;
  Parameter parameter_;
};

constexpr double kHold = 1e3;  // of the middle node, over the steps

class BiasWalkRows final : public Measurement {
 public:
  BiasWalkRows(std::string name, std::size_t imu, const Vector6d& inverse_sigma)
      : name_(std::move(name)), imu_(imu), inverse_sigma_(inverse_sigma) {}

  std::vector<std::string> sensors() const override { return {name_ + ".bias_walk"}; }
  Time time() const override { return {}; }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    const BiasWalk& walk = state.bias_walks[imu_];
    const auto steps = static_cast<Eigen::Index>(walk.node.size()) - 1, middle = steps / 2;
    rows.start(6 * steps + 6);
    for (Eigen::Index i = 0; i < steps; ++i) {
      const auto n = static_cast<std::size_t>(i);
      rows.r.segment<6>(6 * i) = inverse_sigma_.cwiseProduct(walk.node[n + 1] - walk.node[n]);
    }
    rows.r.tail<6>() = kHold * inverse_sigma_.cwiseProduct(walk.node[static_cast<std::size_t>(middle)]);
    square(rows);
    if (!derivatives) return;
    for (const int column : columns.layout.bias[imu_]) rows.append(column, 6);
    rows.allocate_jacobian();
    for (Eigen::Index i = 0; i < steps; ++i) {
      rows.J.block<6, 6>(6 * i, 6 * i).diagonal() = -inverse_sigma_;
      rows.J.block<6, 6>(6 * i, 6 * i + 6).diagonal() = inverse_sigma_;
    }
    rows.J.block<6, 6>(6 * steps, 6 * middle).diagonal() = kHold * inverse_sigma_;
  }

 private:
  std::string name_;
  std::size_t imu_;
  Vector6d inverse_sigma_;
};

class SmoothnessRows final : public Measurement {
 public:
  SmoothnessRows(const Smoothness& smoothness, std::size_t first, std::size_t last)
      : smoothness_(smoothness), first_(first), last_(last) {}

  std::vector<std::string> sensors() const override { return {"smoothness"}; }
  bool only_holds() const override { return true; }
  Time time() const override { return {}; }

  void evaluate(const State& state, const Columns& columns, bool derivatives, Rows& rows) const override {
    const Curve& curve = *state.curve;
    const double dt = to_seconds(curve.spacing());
    Vector6d scale;
    scale << Vector3d::Constant(1.0 / (smoothness_.acceleration_sigma * dt * dt)),
        Vector3d::Constant(1.0 / (smoothness_.alpha_sigma * dt * dt));
    const auto bends = static_cast<Eigen::Index>(last_ - first_) - 1;
    rows.start(6 * bends);
    if (derivatives) {
      for (std::size_t k = first_; k <= last_; ++k) rows.append(columns.layout.knot[k], 6);
      rows.allocate_jacobian();
    }
    for (Eigen::Index i = 0; i < bends; ++i) {
      const Curve::Bend bend = curve.bend(first_ + static_cast<std::size_t>(i));
      rows.r.segment<6>(6 * i) = scale.cwiseProduct(bend.value);
      if (derivatives) rows.J.block<6, 18>(6 * i, 6 * i) = scale.asDiagonal() * bend.J;
    }
    square(rows);
  }

 private:
  Smoothness smoothness_;
  std::size_t first_, last_;
};

}  // namespace

std::unique_ptr<Measurement> prior_measurement(const State& start, const Parameter& parameter) {
  return std::make_unique<PriorRows>(start, parameter);
}

std::unique_ptr<Measurement> bias_walk_measurement(const State& state, std::size_t imu, double gyro_walk,
                                                   double accel_walk) {
  const double root = std::sqrt(to_seconds(state.bias_walks[imu].spacing));
  Vector6d inverse_sigma;
  inverse_sigma << Vector3d::Constant(1.0 / (gyro_walk * root)), Vector3d::Constant(1.0 / (accel_walk * root));
  return std::make_unique<BiasWalkRows>(state.rig.imus[imu].name, imu, inverse_sigma);
}

std::unique_ptr<Measurement> smoothness_measurement(const Smoothness& smoothness, std::size_t first_knot,
                                                    std::size_t last_knot) {
  return std::make_unique<SmoothnessRows>(smoothness, first_knot, last_knot);
}

}  // namespace vispline
