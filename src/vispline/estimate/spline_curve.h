/// Curve over one kind and order of spline; included only by the files that instantiate it.
#pragma once

#include <utility>

#include "vispline/estimate/curve.h"
#include "vispline/trajectory/pose_spline.h"

namespace vispline {

template <class G, int K>
class SplineCurve final : public Curve {
 public:
  explicit SplineCurve(Spline<G, K> spline) : pose_spline_(std::move(spline)) {}

  SplineKind kind() const override { return std::is_same_v<G, SE3> ? SplineKind::kJoint : SplineKind::kSplit; }
  int order() const override { return K; }
  TimeSpan span() const override { return spline().span(); }
  Duration spacing() const override { return spline().spacing(); }
  std::size_t knots() const override { return spline().knots().size(); }
  Time knot_time(std::size_t k) const override {
    return span().begin + (2 * static_cast<std::int64_t>(k) - (K - 2)) * spacing() / 2;
  }
  std::size_t first_knot(const Instant& at) const override { return spline().locate(at.time, at.extra_s).first; }

  BodyState state(const Instant& at) const override {
    const Evaluation<2> e(spline(), at);
    return BodyFrame<G>::state(e.point.X, e.point.V(), e.point.dV());
  }

  Pose pose(const Instant& at) const override { return spline().element(spline().locate(at.time, at.extra_s)); }

  PoseSample sample(const Instant& at, bool derivatives) const override {
    const Evaluation<1> e(spline(), at);
    PoseSample sample{e.point.X, BodyFrame<G>::twist(e.point.X, e.point.V()), {}};
    if (!derivatives) return sample;
    const auto J = cumulative_jacobian<G, K, 0>(e.point, &spline().pairs()[e.place.first]);
    sample.d_knots.first = e.place.first;
    sample.d_knots.J.resize(6, 6 * K);
    for (int m = 0; m < K; ++m) {
      sample.d_knots.J.template middleCols<6>(6 * m) = in_body(e.point.X.R, J.X[static_cast<std::size_t>(m)].dense());
    }
    return sample;
  }

  KnotRows<2> pull_back_pixel(const Instant& at, const PixelRows& d_pose) const override {
    const Evaluation<1> e(spline(), at);
    const Pose& X = e.point.X;
    const auto L = BodyFrame<G>::pose_rows(X, d_pose(X, BodyFrame<G>::twist(X, e.point.V())));
    return knot_rows<2>(e.place.first, cumulative_pull_back<G, K, 2>(e.point, &spline().pairs()[e.place.first], L));
  }

  KnotRows<6> pull_back(const Instant& at, const ImuRows& d_state) const override {
    const Evaluation<2> e(spline(), at);
    const Kinematics<G> k{e.point.X, e.point.V(), e.point.dV(), e.point.ddV()};
    const BodyJacobian<6> L = d_state(BodyFrame<G>::state(k.X, k.V, k.dV), BodyFrame<G>::rate(k));
    const auto rows = BodyFrame<G>::template pull_back<6>(k, L);
    return knot_rows<6>(e.place.first, cumulative_pull_back<G, K, 6>(e.point, &spline().pairs()[e.place.first], rows.X,
                                                                     rows.V, rows.dV));
  }

  Bend bend(std::size_t k) const override {
    const KnotPair<G>&before = spline().pairs()[k], &after = spline().pairs()[k + 1];
    const auto J_l_inv = [](const KnotPair<G>& pair) {
      return Matrix6d(pair.Jr_inv.dense() - G::template ad<double>(pair.d).dense());
    };
    Bend bend;
    bend.value = after.d - before.d;
    bend.J << J_l_inv(before), -J_l_inv(after) - before.Jr_inv.dense(), after.Jr_inv.dense();
    return bend;
  }

  void retract(const std::vector<Vector6d>& delta) override { pose_spline_.spline().retract(delta); }
  const std::vector<Pose>& knot_poses() const override { return spline().knots(); }
  std::unique_ptr<Curve> clone() const override { return std::make_unique<SplineCurve>(*this); }
  Trajectory trajectory() const override { return Trajectory(pose_spline_); }

 private:
  template <int kDerivatives>
  struct Evaluation {
    typename Spline<G, K>::Place place;
    CumulativeBasis<K> basis;
    CumulativePoint<G, K, double, kDerivatives> point;
    Evaluation(const Spline<G, K>& spline, const Instant& at)
        : place(spline.locate(at.time, at.extra_s)),
          basis(spline.basis(place)),
          point(spline.template point<kDerivatives>(place, basis)) {}
  };

  /// The tangent of the group as the right perturbation of a pose: of the split pose, positions are moved in w.
  static Matrix6d in_body(const Matrix3d& R_w_b, Matrix6d J) {
    if constexpr (std::is_same_v<G, SplitPose>) J.topRows<3>() = (R_w_b.transpose() * J.topRows<3>()).eval();
    return J;
  }

  template <int kRows>
  static KnotRows<kRows> knot_rows(std::size_t first, const std::array<Eigen::Matrix<double, kRows, 6>, K>& blocks) {
    KnotRows<kRows> rows{first, {}};
    rows.J.resize(kRows, 6 * K);
    for (int m = 0; m < K; ++m) rows.J.template middleCols<6>(6 * m) = blocks[static_cast<std::size_t>(m)];
    return rows;
  }

  const Spline<G, K>& spline() const { return pose_spline_.spline(); }

  PoseSpline<G, K> pose_spline_;
};

template <class G, int K>
std::unique_ptr<Curve> make_spline_curve(Duration spacing, TimeSpan span, const std::function<Pose(Time)>& pose_at) {
  std::vector<Pose> knots;
  const std::size_t count = Spline<G, K>::knots_for(span.end - span.begin, spacing);
  for (std::size_t k = 0; k < count; ++k) {
    knots.push_back(pose_at(span.begin + (2 * static_cast<std::int64_t>(k) - (K - 2)) * spacing / 2));
  }
  return std::make_unique<SplineCurve<G, K>>(Spline<G, K>(span.begin, spacing, std::move(knots)));
}

}  // namespace vispline
