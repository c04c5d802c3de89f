// A new file format: what its columns are, and how to tell. docs/extending.md, "A file format".
#include <cstdio>

#include "vispline/io/column_plan.h"
#include "vispline/io/text_layout.h"

using namespace vispline;

/// A logger that writes `ms;ax;ay;az;gx;gy;gz` below a comment that names it, accelerations in g, rates in deg/s.
namespace robolog {

inline constexpr std::string_view kName = "robolog";
inline constexpr std::string_view kOrder = "t ax ay az gx gy gz";

ColumnPlan positional() {
  ColumnPlan plan = plan_by_order(kOrder);
  plan.format = kName;
  plan.time_unit = TimeUnit{.kind = TimeUnit::Kind::kMilliseconds};
  plan.gyro_unit = 0.017453292519943295;  // rad/s per deg/s
  plan.accel_unit = 9.80665;              // m/s^2 per g
  return plan;
}

/// Its own first column name and separator; anything else is another format's.
std::optional<ColumnPlan> recognizes(const ReadContext&, const TextLayout& layout) {
  if (layout.separator != ';' || layout.header.empty() || layout.header.front() != "robo_ms") return std::nullopt;
  return positional();
}

}  // namespace robolog

int main() {
  const std::string text =
      "# robo_ms;ax;ay;az;gx;gy;gz\n"
      "1000;0.001;-0.002;1.000;0.5;0.1;-0.2\n"
      "1005;0.002;-0.001;0.999;0.4;0.0;-0.3\n";
  ReadContext context("log.txt", "IMU samples", ReadOptions{});
  const TextLayout layout = find_layout(context, text);
  const std::optional<ColumnPlan> plan = robolog::recognizes(context, layout);
  if (!plan) return 1;
  std::printf("format %s: x of the gyroscope is column %d\n", plan->format.c_str(), plan->column[kGyroX]);
  return plan->has_imu() && !plan->has_poses() && plan->column[kGyroX] == 4 ? 0 : 1;
}
