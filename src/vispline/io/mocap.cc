#include "vispline/io/mocap.h"

#include "vispline/io/format_words.h"

namespace vispline::mocap {

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout) {
  if (layout.separator != ',') return std::nullopt;
  if (layout.header.empty()) {
    const bool fits = layout.fields == 8 && sample_is_epoch_nanoseconds(layout) && sample_holds_quaternions(layout, 4);
    if (!fits) return std::nullopt;
    ColumnPlan plan = positional();
    plan.assumed = "t [ns],px,py,pz,qw,qx,qy,qz";
    return plan;
  }
  if (!names_hold(layout.header, "p_rs_r_x") || !names_hold(layout.header, "q_rs_w")) return std::nullopt;
  ColumnPlan plan = plan_by_names(context, layout.header);
  plan.format = kName;
  if (!plan.time_unit) plan.time_unit = TimeUnit{.kind = TimeUnit::Kind::kNanoseconds};
  return plan;
}

ColumnPlan positional() {
  ColumnPlan plan = plan_by_order(kOrder);
  plan.format = kName;
  plan.time_unit = TimeUnit{.kind = TimeUnit::Kind::kNanoseconds};
  return plan;
}

void append_pose(std::string& out, Time time, const Pose& T_w_b) {
  const Eigen::Quaterniond q = T_w_b.quaternion();
  append_number(out, to_ns(time));
  append_cells(out, ',', T_w_b.p);
  append_cells(out, ',', Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
}

std::string text(const Signal<Pose>& T_w_b) {
  std::string out(kHeader);
  out += '\n';
  for (std::size_t i = 0; i < T_w_b.size(); ++i) {
    append_pose(out, T_w_b.time[i], T_w_b.value[i]);
    out += '\n';
  }
  return out;
}

}  // namespace vispline::mocap
