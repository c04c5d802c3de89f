/// A cumulative B-spline of order K on a Lie group G over uniformly spaced knots. docs/math/spline.md, section 3.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/core/time.h"
#include "vispline/trajectory/cumulative_jacobian.h"

namespace vispline {

/// Knots k = 0..n-1 at begin + (k - (K-2)/2) spacing; the curve is defined on [begin, begin + (n-K+1) spacing].
/// Segments are half-open, the last one is closed: an instant exactly on a knot belongs to the segment it begins.
template <class G, int K>
class Spline {
 public:
  static constexpr int kOrder = K;
  using Group = G;
  using Element = typename G::template Element<double>;
  using Tangent = typename G::template Tangent<double>;
  using Point = CumulativePoint<G, K>;

  /// Where an instant falls: the first of its K knots and the place u in [0, 1] inside the segment.
  struct Place {
    std::size_t first;
    double u;
  };

  Spline(Time begin, Duration spacing, std::vector<Element> knots)
      : begin_(begin), spacing_(spacing), knots_(std::move(knots)) {
    require(spacing.count() > 0, "a positive knot spacing");
    require(knots_.size() >= K, "at least as many knots as the order of the spline");
    refresh();
  }

  /// Knots that a curve over `span` needs.
  static std::size_t knots_for(Duration span, Duration spacing) {
    return static_cast<std::size_t>((span.count() + spacing.count() - 1) / spacing.count()) + K - 1;
  }

  TimeSpan span() const { return {begin_, begin_ + spacing_ * static_cast<std::int64_t>(knots_.size() - K + 1)}; }
  Duration spacing() const { return spacing_; }
  const std::vector<Element>& knots() const { return knots_; }
  const std::vector<KnotPair<G>>& pairs() const { return pairs_; }

  /// One solver step: knot k becomes X_k exp(delta_k) for all k. The pairs are refreshed once.
  void retract(const std::vector<Tangent>& delta) {
    for (std::size_t k = 0; k < knots_.size(); ++k) {
      knots_[k] = G::template compose<double>(knots_[k], G::template exp<double>(delta[k]));
    }
    refresh();
  }

  /// Precondition: span() contains `time`. Integer arithmetic, so no stamp is ever given to the wrong segment.
  Place locate(Time time) const {
    const std::int64_t offset = (time - begin_).count();
    const auto last = static_cast<std::int64_t>(knots_.size()) - K;
    const std::int64_t segment = std::min(offset / spacing_.count(), last);
    const std::int64_t rest = offset - segment * spacing_.count();
    return {static_cast<std::size_t>(segment), static_cast<double>(rest) / static_cast<double>(spacing_.count())};
  }

  /// The same for time + extra_s, without rounding to whole nanoseconds: what is differentiated with respect to a time
  /// offset must not move in steps. Outside span() the end segments are continued: u leaves [0, 1].
  Place locate(Time time, double extra_s) const {
    const std::int64_t offset = (time - begin_).count();
    const auto last = static_cast<std::int64_t>(knots_.size()) - K;
    const std::int64_t near = std::clamp(offset / spacing_.count(), std::int64_t{0}, last);
    const double u =
        (static_cast<double>(offset - near * spacing_.count()) + extra_s * 1e9) / static_cast<double>(spacing_.count());
    const std::int64_t segment = std::clamp(near + static_cast<std::int64_t>(std::floor(u)), std::int64_t{0}, last);
    return {static_cast<std::size_t>(segment), u - static_cast<double>(segment - near)};
  }

  CumulativeBasis<K> basis(const Place& place) const { return {place.u, to_seconds(spacing_)}; }

  /// The instant that values and Jacobians share; `basis` must outlive it.
  template <int kDerivatives = 2>
  CumulativePoint<G, K, double, kDerivatives> point(const Place& place, const CumulativeBasis<K>& basis) const {
    return {knots_[place.first], increments(place.first), basis};
  }

  Element element(Time time) const { return element(locate(time)); }
  Element element(const Place& place) const {
    return cumulative_element<G, K, double>(knots_[place.first], increments(place.first), basis(place));
  }

  Kinematics<G> kinematics(Time time) const {
    const Place place = locate(time);
    const CumulativeBasis<K> b = basis(place);
    const Point p = point(place, b);
    return {p.X, p.V(), p.dV(), p.ddV()};
  }

  CumulativeJacobian<G, K> jacobian(const Place& place, const Point& p) const {
    return cumulative_jacobian<G, K>(p, &pairs_[place.first]);
  }

 private:
  std::array<Tangent, K - 1> increments(std::size_t first) const {
    std::array<Tangent, K - 1> d;
    for (std::size_t j = 0; j + 1 < K; ++j) d[j] = pairs_[first + j].d;
    return d;
  }

  void refresh() {
    pairs_.clear();
    pairs_.reserve(knots_.size() - 1);
    for (std::size_t k = 0; k + 1 < knots_.size(); ++k) pairs_.emplace_back(knots_[k], knots_[k + 1]);
  }

  Time begin_;
  Duration spacing_;
  std::vector<Element> knots_;
  std::vector<KnotPair<G>> pairs_;
};

}  // namespace vispline
