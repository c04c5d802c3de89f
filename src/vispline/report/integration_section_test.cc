#include "vispline/report/integration_section.h"

#include <gtest/gtest.h>

namespace vispline::report {
namespace {

IntegrationRow row(const std::string& method, double rate_hz, double error_m, std::optional<double> order) {
  return {method, rate_hz, {.final_error_m = error_m, .max_error_m = error_m, .rmse_m = error_m}, order};
}

TEST(IntegrationSection, HasARowPerResultAndALinePerMethod) {
  const Section section = integration_section(
      "Table", "Text",
      {row("euler", 100.0, 1.0, std::nullopt), row("euler", 200.0, 0.5, 1.0), row("rk4", 142.857, 1e-3, 2.0)});
  const auto& plot = std::get<Figure>(section.blocks[1]).plots.at(0);
  ASSERT_EQ(plot.series.size(), 2u);
  EXPECT_EQ(plot.series[0].name, "euler");
  EXPECT_EQ(plot.series[0].x, (std::vector<double>{100.0, 200.0}));
  EXPECT_EQ(plot.series[0].y, (std::vector<double>{1.0, 0.5}));
  EXPECT_TRUE(plot.log_x && plot.log_y);
  const auto& table = std::get<Table>(section.blocks[2]);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.rows[0].size(), table.columns.size());
  EXPECT_EQ(std::get<std::int64_t>(table.rows[1][1]), 200);
  EXPECT_EQ(std::get<double>(table.rows[2][1]), 142.857);
  EXPECT_EQ(std::get<std::string>(table.rows[0].back()), "") << "the lowest rate has no order";
  EXPECT_EQ(std::get<double>(table.rows[1].back()), 1.0);
}

}  // namespace
}  // namespace vispline::report
