#include "vispline/io/feature_rows.h"

#include <cmath>

#include "vispline/io/column_plan.h"

namespace vispline {
namespace {
constexpr double kMostId = 9007199254740992.0;  // 2^53
}

std::uint64_t id_of(const ReadContext& context, double value, std::int64_t line) {
  if (value >= 0.0 && value <= kMostId && value == std::floor(value)) return static_cast<std::uint64_t>(value);
  context.fail(ExitCode::kInput, "E-CSV", "the id " + brief(value) + " is not a whole number from 0 to 2^53",
               context.where_line(line), "number the points from 0");
}

TimeUnit feature_time_unit(const ReadContext& context, const TextLayout& layout, const std::vector<Decimal>& stamps) {
  if (!context.options().time_unit.empty()) return parse_time_unit(context.options().time_unit);
  const auto declared =
      layout.header.empty() ? std::nullopt : time_unit_named(parse_column_name(layout.header[0]).unit);
  return settle_time_unit(context, stamps, true, declared);
}

void require_feature_options(const ReadOptions& options) {
  const bool foreign = !options.columns.empty() || !options.format.empty() || options.rate_hz != 0.0 ||
                       !options.gyro_unit.empty() || !options.accel_unit.empty();
  require(!foreign,
          "of the flags for tables only --time-unit, --decimal, --skip-bad-rows, --repair and --strict "
          "for features");
}

}  // namespace vispline
