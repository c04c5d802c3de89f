#include "vispline/report/allan_section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vispline/report/allan_plots.h"
#include "vispline/report/allan_tables.h"
#include "vispline/report/markup_testing.h"
#include "vispline/results/allan_result_testing.h"

namespace vispline::report {
namespace {

std::vector<std::string> headings(const std::vector<Section>& sections) {
  std::vector<std::string> names;
  for (const Section& section : sections) names.push_back(section.heading);
  return names;
}

template <class Kind>
std::vector<Kind> blocks_of(const Section& section) {
  std::vector<Kind> found;
  for (const Block& block : section.blocks) {
    if (const Kind* kind = std::get_if<Kind>(&block)) found.push_back(*kind);
  }
  return found;
}

TEST(AllanSection, SectionsFollowTheSensors) {
  EXPECT_EQ(headings(allan_sections(synthetic_allan_result())),
            (std::vector<std::string>{"In short", "Gyroscope", "Accelerometer", "To copy", "Checks of the record",
                                      "What imu_utils would print"}));
  EXPECT_EQ(headings(allan_sections(odd_allan_result())),
            (std::vector<std::string>{"In short", "Gyroscope", "Series", "To copy", "Checks of the record"}));
}

TEST(AllanSection, EverySensorHasItsCurvesAndEveryAxisItsTermsAndResiduals) {
  const auto figures = blocks_of<Figure>(allan_sections(synthetic_allan_result())[1]);
  ASSERT_EQ(figures.size(), 4u);
  EXPECT_EQ(figures[0].plots.at(0).series.size(), 6u) << "a band and a line for each axis";
  EXPECT_EQ(figures[0].plots[0].y_label, "overlapping Allan deviation [rad/s]");
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(figures[i].plots.size(), 2u);
  EXPECT_TRUE(blocks_of<Figure>(allan_sections(odd_allan_result())[1]).empty()) << "a constant axis has no curve";
}

TEST(AllanPlots, EachResolvedTermIsALineWithItsNameInsideTheBox) {
  const AllanResult result = synthetic_allan_result();
  const Plot plot = terms_plot(result.signals[5]);
  std::vector<std::string> names;
  for (const Annotation& note : plot.annotations) {
    names.push_back(note.text);
    EXPECT_GE(note.y, plot.y_range->lo) << note.text;
    EXPECT_LE(note.y, plot.y_range->hi) << note.text;
    EXPECT_GE(note.x, result.signals[5].curves[0].tau_s.front()) << note.text;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"Q −1", "N −1/2", "B flat", "K +1/2"}));
  const Series& white = plot.series[1];
  EXPECT_DOUBLE_EQ(white.y[7], 2.8e-3 / std::sqrt(white.x[7]));
  const Series& total = plot.series.back();
  EXPECT_EQ(total.name, "terms together");
  EXPECT_EQ(total.y[40], result.signals[5].terms.deviation(total.x[40]));
}

TEST(AllanPlots, ResidualsArePerCentOfTheFit) {
  SignalAnalysis signal = synthetic_allan_result().signals[0];
  AllanCurve& curve = signal.curves[0];
  curve.value[10] = 1.25 * signal.terms.deviation(curve.tau_s[10]);
  curve.low[10] = 0.5 * signal.terms.deviation(curve.tau_s[10]);
  const Plot plot = residual_plot(signal);
  EXPECT_NEAR(plot.series[2].y[10], 25.0, 1e-9);
  EXPECT_NEAR(plot.series[1].lower[10], -50.0, 1e-9);
  EXPECT_FALSE(plot.log_y);
  EXPECT_EQ(plot.y_range->lo, -plot.y_range->hi);
}

TEST(AllanPlots, OnlyTheKindAskedForIsDrawn) {
  AllanResult result = synthetic_allan_result();
  result.signals[1].curves.push_back(result.signals[1].curves[0]);
  result.signals[1].curves[1].deviation = Deviation::kTdev;
  const Plot plot = curves_plot(result, summarize(result)[0], Deviation::kTdev);
  ASSERT_EQ(plot.series.size(), 2u);
  EXPECT_EQ(plot.series[1].name, "gyroscope y");
  EXPECT_EQ(plot.series[1].colour, 1) << "an axis keeps its colour";
  EXPECT_EQ(plot.y_label, "time deviation [rad]");
}

TEST(AllanPlots, UnitsOfAPage) {
  EXPECT_EQ(pretty_unit("m/s^3/sqrt(Hz)"), "m/s³/√Hz");
  EXPECT_EQ(pretty_unit("rad/s^2"), "rad/s²");
  EXPECT_EQ(pretty_unit(""), "");
}

TEST(AllanTables, TermsHaveAnIntervalOrABound) {
  const AllanResult result = synthetic_allan_result();
  const Table table = terms_table(result, summarize(result)[0]);
  ASSERT_EQ(table.rows.size(), kTerms);
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  EXPECT_EQ(std::get<std::string>(table.rows[0][1]), "1.70e-4 (−0.57\u00a0+0.75\u00a0%)");
  EXPECT_EQ(std::get<std::string>(table.rows[1][3]), "< 3.10e-6");
  EXPECT_EQ(std::get<std::string>(table.rows[1][4]), "rad/s²/√Hz");
  const AllanResult odd = odd_allan_result();
  EXPECT_EQ(std::get<std::string>(terms_table(odd, summarize(odd)[0]).rows[0][1]), "constant");
  EXPECT_EQ(std::get<std::string>(terms_table(odd, summarize(odd)[1]).rows[1][1]), "—");
}

TEST(AllanTables, ImuUtilsStandsBesideWhatNAndKSay) {
  const AllanResult result = synthetic_allan_result();
  const Table table = imu_utils_table(summarize(result), result.rate_hz);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_NEAR(std::get<double>(table.rows[0][2]), 1.8e-4 * std::sqrt(200.0), 1e-15);
  EXPECT_NEAR(std::get<double>(table.rows[0][4]), std::sqrt(2.0 * 1.8e-4 * 2.25e-6 / std::sqrt(3.0)), 1e-15);
  EXPECT_TRUE(imu_utils_table(summarize(odd_allan_result()), 10.0).rows.empty());
}

TEST(AllanTables, TheTextToCopyHasAsManyCellsInEveryLine) {
  const std::string text = tsv_text(synthetic_allan_result());
  std::vector<std::string> lines(1);
  for (const char c : text) c == '\n' ? lines.emplace_back() : lines.back() += c;
  ASSERT_EQ(lines.size(), 8u);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(std::count(lines[i].begin(), lines[i].end(), '\t'), 22) << lines[i];
  EXPECT_TRUE(lines[1].starts_with("gyroscope\tx\trad/s\t1.700e-04\t1.690e-04\t1.713e-04\t\t2.000e-06")) << lines[1];
  EXPECT_NE(lines[3].find("\t\t\t\t3.100e-06\t"), std::string::npos) << lines[3];
}

TEST(AllanPage, IsWellFormedAndTheSameEveryTime) {
  const std::string page = allan_page(synthetic_allan_result(), "<imu>");
  const MarkupReader read(page);
  EXPECT_EQ(read.named("h1").at(0).text, "<imu>");
  EXPECT_EQ(read.named("pre").size(), 2u);
  EXPECT_EQ(page, allan_page(synthetic_allan_result(), "<imu>"));
  EXPECT_NO_THROW(MarkupReader(allan_page(odd_allan_result(), "odd")));
  EXPECT_NO_THROW(MarkupReader(allan_page(AllanResult(), "nothing")));
}

TEST(AllanPage, TextOfDiagnosticsStaysText) {
  AllanResult result = synthetic_allan_result();
  result.diagnostics.add({"W-SPIKE", "<script>alert(1)</script>", "", "</td>", ""});
  const MarkupReader read(allan_page(result, "x"));
  EXPECT_TRUE(read.named("script").empty());
  const auto cells = read.named("td");
  EXPECT_TRUE(std::any_of(cells.begin(), cells.end(), [](const ParsedElement& e) { return e.text == "</td>"; }));
}

}  // namespace
}  // namespace vispline::report
