/// A curve in time: the plain value that simulators, fits and reports hand to each other.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "vispline/core/body_state.h"
#include "vispline/core/time.h"

namespace vispline {

/// Any curve with `TimeSpan span() const` and `BodyState at(Time) const`, by value; copies share the curve.
class Trajectory {
 public:
  template <class Curve>
  explicit Trajectory(Curve curve) : curve_(std::make_shared<Model<Curve>>(std::move(curve))) {}

  /// The closed interval on which the curve is defined.
  TimeSpan span() const { return curve_->span(); }

  /// State at `time`; empty outside span().
  std::optional<BodyState> at(Time time) const {
    if (!span().contains(time)) return std::nullopt;
    return curve_->at(time);
  }

 private:
  struct Concept {
    virtual ~Concept() = default;
    virtual TimeSpan span() const = 0;
    virtual BodyState at(Time) const = 0;
  };
  template <class Curve>
  struct Model final : Concept {
    explicit Model(Curve c) : curve(std::move(c)) {}
    TimeSpan span() const override { return curve.span(); }
    BodyState at(Time time) const override { return curve.at(time); }
    Curve curve;
  };
  std::shared_ptr<const Concept> curve_;
};

}  // namespace vispline
