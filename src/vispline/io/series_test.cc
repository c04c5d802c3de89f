#include "vispline/io/series.h"

#include <cmath>

#include "vispline/files/output_file.h"
#include "vispline/io/io_testing.h"

namespace vispline {
namespace {

struct SeriesOutcome {
  int exit = 0;
  std::string codes, where;
  std::vector<double> values;
};

SeriesOutcome outcome_for(const std::string& path, const ReadOptions& options = {}) {
  SeriesOutcome outcome;
  try {
    auto result = read_series(path, options);
    for (const auto& [code, count] : result.diagnostics.counts())
      outcome.codes += (outcome.codes.empty() ? "" : " ") + code;
    EXPECT_EQ(result.counts.read, result.counts.kept + result.counts.dropped_total());
    EXPECT_EQ(static_cast<std::size_t>(result.counts.kept), result.value.size());
    outcome.values = std::move(result.value);
  } catch (const Error& error) {
    outcome.exit = static_cast<int>(error.exit_code());
    outcome.codes = error.diagnostic().code;
    outcome.where = error.diagnostic().where;
  }
  return outcome;
}

TEST(Series, OneColumnOrOneOfSeveral) {
  const ScratchFolder folder;
  const std::vector<double> numbers = {1.5, -2e-9, 3};
  const auto values = [&](const std::string& bytes, const ReadOptions& options = {}) {
    return outcome_for(folder.write("f", bytes), options).values;
  };
  EXPECT_EQ(values("1.5\n-2e-9\n3\n"), numbers);
  EXPECT_EQ(values("# a clock\n%\n\n  1.5\r\n-2e-9 \r\n\n3\r\n"), numbers);
  EXPECT_EQ(values("phase [s]\n1.5\n-2e-9\n3\n"), numbers);
  EXPECT_EQ(values("1,5\n-2e-9\n3\n", {.decimal = ','}), numbers);
  EXPECT_EQ(values("7 1.5\n8 -2e-9\n9 3\n", {.columns = "-,value"}), numbers);
  EXPECT_EQ(values("time,phase,temp\n7,1.5,x\n8,-2e-9,\n9,3,y\n", {.columns = "-, value, -"}), numbers);
  EXPECT_EQ(values("1.5\n2.5\n"), values("1.50\n2.50\n"));
  for (const char* name : {"f.gz", "f.xz"}) {
    write_file(folder.path(name), "1.5\n-2e-9\n3\n");
    EXPECT_EQ(outcome_for(folder.path(name)).values, numbers);
  }
}

TEST(Series, IsStrict) {
  const ScratchFolder folder;
  std::string many;
  for (int i = 0; i < 200; ++i) many += std::to_string(i) + ".25\n";
  const struct {
    const char* name;
    std::string bytes, codes;
    int exit;
    std::size_t kept;
    ReadOptions options;
  } cases[] = {
      {"empty", "", "E-EMPTY", 3, 0, {}},
      {"only comments", "# 1\n# 2\n", "E-EMPTY", 3, 0, {}},
      {"text", many + "abc\n" + many, "E-CSV", 3, 0, {}},
      {"number and text", many + "1.5abc\n" + many, "E-CSV", 3, 0, {}},
      {"two cells", many + "1.5 2\n" + many, "E-CSV", 3, 0, {}},
      {"decimal comma", many + "1,5\n" + many, "E-DECIMAL", 3, 0, {}},
      {"beyond doubles", many + "1e400\n", "E-CSV", 3, 0, {}},
      {"cut", many + "7.2", "W-TRUNCATED", 0, 200, {}},
      {"no line end", many + "7.25", "", 0, 201, {}},
      {"one nan", many + "nan\n" + many, "W-NONFINITE", 0, 401, {}},
      {"many nan", many + "nan\ninf\nnan\n", "E-NONFINITE", 4, 0, {}},
      {"many nan, repaired", many + "nan\ninf\nnan\n", "W-NONFINITE", 0, 203, {.repair = true}},
      {"strict", many + "nan\n" + many, "E-NONFINITE", 4, 0, {.strict = true}},
      {"two columns", "1 2\n3 4\n", "E-COLUMNS", 3, 0, {}},
      {"columns too few", "1 2\n3 4\n", "E-COLUMNS", 3, 0, {.columns = "value"}},
      {"no value", "1 2\n3 4\n", "E-COLUMNS", 2, 0, {.columns = "-,-"}},
      {"two values", "1 2\n3 4\n", "E-COLUMNS", 2, 0, {.columns = "value,value"}},
      {"other names", "1 2\n3 4\n", "E-COLUMNS", 2, 0, {.columns = "t,value"}},
      {"decimal commas", "0;1,5\n1;2,5\n2;3,5\n", "W-DECIMAL", 0, 3, {.columns = "-,value"}},
      {"a folder", "", "E-OPEN", 3, 0, {}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.name);
    const std::string path = std::string(c.name) == "a folder" ? folder.path("") : folder.write("f", c.bytes);
    const SeriesOutcome outcome = outcome_for(path, c.options);
    EXPECT_EQ(outcome.codes, c.codes);
    EXPECT_EQ(outcome.exit, c.exit);
    EXPECT_EQ(outcome.values.size(), c.kept);
  }
  EXPECT_EQ(outcome_for(folder.write("f", "# x\n" + many + "abc\n")).where, folder.path("f") + ":202");
}

TEST(Series, MissingValuesKeepTheirPlace) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 300; ++i) text += i == 7 ? "inf\n" : std::to_string(i) + "\n";
  const std::vector<double> values = outcome_for(folder.write("f", text)).values;
  ASSERT_EQ(values.size(), 300u);
  EXPECT_EQ(values[6], 6.0);
  EXPECT_TRUE(std::isnan(values[7]));
  EXPECT_EQ(values[8], 8.0);
}

TEST(RecordedData, Clocks) {
  const std::string data = std::string(VISPLINE_SOURCE_DIR) + "/../shared/data/allan/";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no recorded data at hand";
  const SeriesOutcome stable32 = outcome_for(data + "allantools_phasedat/PHASE.DAT");
  ASSERT_EQ(stable32.values.size(), 1001u);
  EXPECT_EQ(stable32.codes, "");
  EXPECT_EQ(stable32.values[1], 8.511601033439709e-02);
  const SeriesOutcome caesium = outcome_for(data + "allantools_cs5071a/5071A_phase.txt.gz");
  ASSERT_EQ(caesium.values.size(), 556990u);
  EXPECT_EQ(caesium.codes, "");
  EXPECT_EQ(caesium.values[0], 7.64278624201e-07);
}

}  // namespace
}  // namespace vispline
