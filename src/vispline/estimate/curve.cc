#include "vispline/estimate/curve.h"

#include "vispline/core/error.h"
#include "vispline/estimate/spline_curve.h"

namespace vispline {

std::unique_ptr<Curve> make_curve(const CurveShape& shape, TimeSpan span, const std::function<Pose(Time)>& pose_at) {
  require(shape.spacing.count() > 0, "a positive knot spacing");
  require(span.begin < span.end, "a trajectory of some length");
  const bool joint = shape.kind == SplineKind::kJoint;
  switch (shape.order) {
    case 4:
      return (joint ? make_spline_curve<SE3, 4> : make_spline_curve<SplitPose, 4>)(shape.spacing, span, pose_at);
    case 5:
      return (joint ? make_spline_curve<SE3, 5> : make_spline_curve<SplitPose, 5>)(shape.spacing, span, pose_at);
    case 6:
      return (joint ? make_spline_curve<SE3, 6> : make_spline_curve<SplitPose, 6>)(shape.spacing, span, pose_at);
    default:
      require(false, "a spline order of 4, 5 or 6");
      return nullptr;
  }
}

}  // namespace vispline
