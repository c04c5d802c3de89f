#include "vispline/io/euroc_imu.h"

#include "vispline/io/format_words.h"
#include "vispline/io/number_text.h"

namespace vispline::euroc_imu {

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout) {
  if (!names_hold(layout.header, "w_rs_s_x") || !names_hold(layout.header, "a_rs_s_x")) return std::nullopt;
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

void append_row(std::string& out, Time time, const ImuSample& sample) {
  append_number(out, to_ns(time));
  append_cells(out, ',', sample.gyro);
  append_cells(out, ',', sample.accel);
  out += '\n';
}

}  // namespace vispline::euroc_imu
