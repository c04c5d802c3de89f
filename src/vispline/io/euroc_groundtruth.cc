#include "vispline/io/euroc_groundtruth.h"

#include "vispline/io/format_words.h"
#include "vispline/io/mocap.h"

namespace vispline::euroc_groundtruth {
namespace {
constexpr std::size_t kColumns = 17;
}

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout) {
  if (layout.fields != kColumns || layout.separator != ',') return std::nullopt;
  if (layout.header.empty()) {
    if (!sample_is_epoch_nanoseconds(layout) || !sample_holds_quaternions(layout, 4)) return std::nullopt;
    ColumnPlan plan = positional();
    plan.assumed = "t [ns],p,q (w first),v,gyro bias,accel bias";
    return plan;
  }
  const bool euroc = names_hold(layout.header, "b_a_rs_s_x");
  if (!euroc && !names_hold(layout.header, "bax")) return std::nullopt;
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

void append_row(std::string& out, Time time, const GroundTruth& state) {
  mocap::append_pose(out, time, state.T_w_b);
  append_cells(out, ',', state.v_w);
  append_cells(out, ',', state.gyro_bias);
  append_cells(out, ',', state.accel_bias);
  out += '\n';
}

std::string text(const Signal<GroundTruth>& states) {
  std::string out(kHeader);
  out += '\n';
  for (std::size_t i = 0; i < states.size(); ++i) append_row(out, states.time[i], states.value[i]);
  return out;
}

}  // namespace vispline::euroc_groundtruth
