#include "vispline/io/tum.h"

#include "vispline/io/format_words.h"

namespace vispline::tum {

std::optional<ColumnPlan> recognizes(const ReadContext&, const TextLayout& layout) {
  const bool named_elsewhere = !layout.header.empty() && !layout.header_in_comment;
  if (layout.fields != 8 || named_elsewhere || layout.separator == ';') return std::nullopt;
  if (layout.header_in_comment && !names_hold(layout.header, "tx") && names_hold(layout.header, "qw"))
    return std::nullopt;
  if (layout.header_in_comment && names_hold(layout.header, "p_rs_r_x")) return std::nullopt;
  ColumnPlan plan = positional();
  if (layout.separator == ',') plan.assumed = "t [s],tx,ty,tz,qx,qy,qz,qw";
  return plan;
}

ColumnPlan positional() {
  ColumnPlan plan = plan_by_order(kOrder);
  plan.format = kName;
  plan.time_unit = TimeUnit{.kind = TimeUnit::Kind::kSeconds};
  return plan;
}

void append_row(std::string& out, Time time, const Pose& T_w_b) {
  append_seconds(out, time);
  append_cells(out, ' ', T_w_b.p);
  append_cells(out, ' ', T_w_b.quaternion().coeffs());
  out += '\n';
}

std::string text(const Signal<Pose>& T_w_b) {
  std::string out;
  for (std::size_t i = 0; i < T_w_b.size(); ++i) append_row(out, T_w_b.time[i], T_w_b.value[i]);
  return out;
}

}  // namespace vispline::tum
