#include "vispline/io/plain_csv.h"

#include "vispline/io/euroc_imu.h"

namespace vispline::plain_csv {

std::optional<ColumnPlan> recognizes(const ReadContext& context, const TextLayout& layout) {
  ColumnPlan plan = plan_by_names(context, layout.header);
  plan.format = kName;
  if (plan.has(kGyroX, 3) || plan.has(kAccelX, 3) || plan.has_poses()) return plan;
  const bool named = !layout.header.empty() && !layout.header_in_comment;
  if (named || layout.fields != 7) return std::nullopt;
  plan = plan_by_order(euroc_imu::kOrder);
  plan.format = kName;
  plan.assumed = "t,gx,gy,gz,ax,ay,az [rad/s, m/s^2]";
  return plan;
}

}  // namespace vispline::plain_csv
