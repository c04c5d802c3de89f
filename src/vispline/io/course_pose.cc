#include "vispline/io/course_pose.h"

#include "vispline/io/format_words.h"

namespace vispline::course_pose {

std::optional<ColumnPlan> recognizes(const ReadContext&, const TextLayout& layout) {
  const bool named = !layout.header.empty();
  if (named || layout.separator != ' ' || (layout.fields != 14 && layout.fields != 15)) return std::nullopt;
  if (!sample_holds_quaternions(layout, 1)) return std::nullopt;
  return positional(layout.fields);
}

ColumnPlan positional(std::size_t fields) {
  ColumnPlan plan = plan_by_order(fields == 15 ? kIntegratedOrder : kOrder);
  plan.format = kName;
  plan.time_unit = TimeUnit{.kind = TimeUnit::Kind::kSeconds};
  return plan;
}

void append_pose(std::string& out, const Pose& T_w_b) {
  const Eigen::Quaterniond q = T_w_b.quaternion();
  append_cells(out, ' ', Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
  append_cells(out, ' ', T_w_b.p);
}

}  // namespace vispline::course_pose
