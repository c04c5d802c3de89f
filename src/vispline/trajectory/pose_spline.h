/// A spline of poses as sensors see it: BodyState out, Jacobians of anything measured on the body back to the knots.
/// docs/math/spline.md, section 5. Joint: G = SE3, the paper's. Split: G = SplitPose.
#pragma once

#include "vispline/core/body_state.h"
#include "vispline/core/se3.h"
#include "vispline/core/split_pose.h"
#include "vispline/trajectory/spline.h"

namespace vispline {

/// d prediction / d (X, V, dV) in the group's own tangents.
template <class G, int kRows>
struct CurveRows {
  Eigen::Matrix<double, kRows, G::kDof> X, V, dV;
};

/// How a group of poses speaks BodyState.
template <class G>
struct BodyFrame;

template <>
struct BodyFrame<SE3> {
  template <class T>
  static BodyStateT<T> state(const PoseT<T>& X, const Vector6<T>& V, const Vector6<T>& dV) {
    const Vector3<T> v = V.template head<3>(), w = V.template tail<3>();
    return {X.R, X.p, X.R * v, w, X.R * (dV.template head<3>() + w.cross(v)), dV.template tail<3>()};
  }

  /// Rows by the right perturbation of the pose, as rows by X.
  template <int kRows>
  static Eigen::Matrix<double, kRows, 6> pose_rows(const Pose& /*X*/, const Eigen::Matrix<double, kRows, 6>& L) {
    return L;
  }

  /// Velocity and angular rate, both in the body's frame.
  static Vector6d twist(const Pose& /*X*/, const Vector6d& V) { return V; }

  /// Time derivative of the state, in its tangent.
  static BodyTangent rate(const Kinematics<SE3>& k) {
    const Vector3d v = k.V.head<3>(), w = k.V.tail<3>(), dv = k.dV.head<3>(), dw = k.dV.tail<3>();
    const Vector3d a_b = dv + w.cross(v);
    BodyTangent rate;
    rate << v, w, k.X.R * a_b, dw, k.X.R * (k.ddV.head<3>() + dw.cross(v) + w.cross(dv) + w.cross(a_b)),
        k.ddV.tail<3>();
    return rate;
  }

  template <int kRows>
  static CurveRows<SE3, kRows> pull_back(const Kinematics<SE3>& at, const BodyJacobian<kRows>& L) {
    using namespace body_tangent;
    const Vector3d v = at.V.template head<3>(), w = at.V.template tail<3>();
    const Vector3d a_b = at.dV.template head<3>() + w.cross(v);
    const Eigen::Matrix<double, kRows, 3> L_v = L.template middleCols<3>(kVelocity) * at.X.R;
    const Eigen::Matrix<double, kRows, 3> L_a = L.template middleCols<3>(kAcceleration) * at.X.R;
    CurveRows<SE3, kRows> rows;
    rows.X = L.template leftCols<6>();
    rows.X.template rightCols<3>() -= L_v * hat(v) + L_a * hat(a_b);
    rows.V << L_v + L_a * hat(w), L.template middleCols<3>(kOmega) - L_a * hat(v);
    rows.dV << L_a, L.template middleCols<3>(kAlpha);
    return rows;
  }
};

template <>
struct BodyFrame<SplitPose> {
  template <class T>
  static BodyStateT<T> state(const PoseT<T>& X, const Vector6<T>& V, const Vector6<T>& dV) {
    return {X.R, X.p, V.template head<3>(), V.template tail<3>(), dV.template head<3>(), dV.template tail<3>()};
  }

  template <int kRows>
  static Eigen::Matrix<double, kRows, 6> pose_rows(const Pose& X, const Eigen::Matrix<double, kRows, 6>& L) {
    Eigen::Matrix<double, kRows, 6> rows = L;
    rows.template leftCols<3>() = L.template leftCols<3>() * X.R.transpose();
    return rows;
  }

  static Vector6d twist(const Pose& X, const Vector6d& V) {
    return (Vector6d() << X.R.transpose() * V.head<3>(), V.tail<3>()).finished();
  }

  static BodyTangent rate(const Kinematics<SplitPose>& k) {
    BodyTangent rate;
    rate << k.X.R.transpose() * k.V.head<3>(), k.V.tail<3>(), k.dV.head<3>(), k.dV.tail<3>(), k.ddV;
    return rate;
  }

  template <int kRows>
  static CurveRows<SplitPose, kRows> pull_back(const Kinematics<SplitPose>& at, const BodyJacobian<kRows>& L) {
    using namespace body_tangent;
    CurveRows<SplitPose, kRows> rows;
    rows.X << L.template leftCols<3>() * at.X.R.transpose(), L.template middleCols<3>(kRotation);
    rows.V << L.template middleCols<3>(kVelocity), L.template middleCols<3>(kOmega);
    rows.dV << L.template middleCols<3>(kAcceleration), L.template middleCols<3>(kAlpha);
    return rows;
  }
};

/// d prediction / d knots: one block of kRows x 6 for each of the K knots from `first` on.
template <int kRows, int K>
struct KnotBlocks {
  std::size_t first;
  std::array<Eigen::Matrix<double, kRows, 6>, K> block;
};

template <class G, int K>
class PoseSpline {
 public:
  explicit PoseSpline(Spline<G, K> spline) : spline_(std::move(spline)) {}

  const Spline<G, K>& spline() const { return spline_; }
  Spline<G, K>& spline() { return spline_; }
  TimeSpan span() const { return spline_.span(); }

  /// Precondition of all three: span() contains `time`.
  BodyState at(Time time) const {
    const Instant instant(spline_, time);
    return BodyFrame<G>::state(instant.point.X, instant.point.V(), instant.point.dV());
  }

  /// d state / d time in the tangent of BodyState: what a time offset needs.
  BodyTangent rate(Time time) const { return BodyFrame<G>::rate(spline_.kinematics(time)); }

  /// Carries d prediction / d state at `time` back to the knots. Reverse mode: cost grows with the rows.
  template <int kRows>
  KnotBlocks<kRows, K> pull_back(Time time, const BodyJacobian<kRows>& d_state) const {
    const Instant instant(spline_, time);
    const auto& p = instant.point;
    const auto rows = BodyFrame<G>::template pull_back<kRows>({p.X, p.V(), p.dV(), {}}, d_state);
    return {instant.place.first,
            cumulative_pull_back<G, K, kRows>(p, &spline_.pairs()[instant.place.first], rows.X, rows.V, rows.dV)};
  }

 private:
  struct Instant {
    typename Spline<G, K>::Place place;
    CumulativeBasis<K> basis;
    CumulativePoint<G, K> point;
    Instant(const Spline<G, K>& spline, Time time)
        : place(spline.locate(time)), basis(spline.basis(place)), point(spline.point(place, basis)) {}
  };
  Spline<G, K> spline_;
};

/// The two kinds of pose spline.
template <int K>
using JointSpline = PoseSpline<SE3, K>;
template <int K>
using SplitSpline = PoseSpline<SplitPose, K>;

}  // namespace vispline
