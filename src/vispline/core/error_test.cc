#include "vispline/core/error.h"

#include <gtest/gtest.h>

namespace vispline {
namespace {

Diagnostic gap(int line) {
  return {.code = "W-GAP",
          .message = "no sample for 0.5 s",
          .where = "imu.csv:" + std::to_string(line),
          .effect = "",
          .next = ""};
}

TEST(Diagnostic, TextHasOneLinePerKnownPart) {
  EXPECT_EQ(to_text({.code = "E-TIME-RESET",
                     .message = "clock set back by 3600.000 s after sample 1000",
                     .where = "imu.csv:1002",
                     .effect = "nothing written; 2000 samples read",
                     .next = "pass --segments"}),
            "error[E-TIME-RESET]: clock set back by 3600.000 s after sample 1000\n"
            "  where:  imu.csv:1002\n"
            "  effect: nothing written; 2000 samples read\n"
            "  next:   pass --segments");
  EXPECT_EQ(to_text(gap(7)), "warning[W-GAP]: no sample for 0.5 s\n  where:  imu.csv:7");
}

TEST(Diagnostic, TextHasNoControlBytes) {
  const std::string text =
      to_text({.code = "E-OPEN", .message = "no a\nb", .where = "\x1b[31m", .effect = "tab\t", .next = "\x7f µ"});
  EXPECT_EQ(text, "error[E-OPEN]: no a\\x0Ab\n  where:  \\x1B[31m\n  effect: tab\\x09\n  next:   \\x7F µ");
}

TEST(Error, CarriesItsDiagnosticAndExitCode) {
  const Error error(ExitCode::kInput,
                    {.code = "E-OPEN", .message = "no such file", .where = "a.csv", .effect = "", .next = ""});
  EXPECT_EQ(error.exit_code(), ExitCode::kInput);
  EXPECT_EQ(error.diagnostic().code, "E-OPEN");
  EXPECT_STREQ(error.what(), "error[E-OPEN]: no such file\n  where:  a.csv");
}

TEST(Require, ThrowsOnlyWhenBroken) {
  EXPECT_NO_THROW(require(true, "a positive rate"));
  try {
    require(false, "a positive rate");
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::kUsage);
    EXPECT_EQ(error.diagnostic().code, "E-ARGUMENT");
    EXPECT_EQ(error.diagnostic().message, "expected a positive rate");
  }
}

TEST(Diagnostics, CountsAllAndKeepsThreeOfEachCode) {
  Diagnostics diagnostics;
  EXPECT_TRUE(diagnostics.empty());
  for (int line = 1; line <= 5; ++line) diagnostics.add(gap(line));
  diagnostics.add({.code = "W-RATE", .message = "jitter", .where = "", .effect = "", .next = ""});
  EXPECT_EQ(diagnostics.counts().at("W-GAP"), 5);
  EXPECT_EQ(diagnostics.counts().at("W-RATE"), 1);
  ASSERT_EQ(diagnostics.examples().size(), 4u);
  EXPECT_EQ(diagnostics.examples()[2].where, "imu.csv:3");
  EXPECT_EQ(diagnostics.examples()[3].code, "W-RATE");
}

TEST(Diagnostics, MergeAddsTheCountsAndKeepsTheLimit) {
  Diagnostics a, b;
  for (int line = 1; line <= 2; ++line) a.add(gap(line));
  for (int line = 11; line <= 20; ++line) b.add(gap(line));
  a.merge(b);
  EXPECT_EQ(a.counts().at("W-GAP"), 12);
  ASSERT_EQ(a.examples().size(), 3u);
  EXPECT_EQ(a.examples()[2].where, "imu.csv:11");
}

TEST(Diagnostics, MergeIntoNothingIsACopy) {
  Diagnostics a, b;
  for (int line = 1; line <= 10; ++line) b.add(gap(line));
  a.merge(b);
  EXPECT_EQ(a.counts(), b.counts());
  EXPECT_EQ(a.examples().size(), b.examples().size());
}

TEST(ReadCounts, DroppedIsSummedOverItsReasons) {
  const ReadCounts counts{.read = 10, .kept = 7, .dropped = {{"W-DUPLICATE", 2}, {"W-NONFINITE", 1}}};
  EXPECT_EQ(counts.dropped_total(), 3);
  EXPECT_EQ(counts.kept + counts.dropped_total(), counts.read);
  EXPECT_EQ(ReadCounts{}.dropped_total(), 0);
}

TEST(Quoted, EscapesControlBytesAndCutsLongText) {
  EXPECT_EQ(vispline::quoted("plain"), "'plain'");
  EXPECT_EQ(vispline::quoted(std::string_view("a\x1b[31m\0\n\x7f", 9)), "'a\\x1B[31m\\x00\\x0A\\x7F'");
  EXPECT_EQ(vispline::quoted("\xc3\xa9"), "'\xc3\xa9'");  // UTF-8 passes
  EXPECT_EQ(vispline::quoted(std::string(200, 'x')), "'" + std::string(200, 'x') + "'");
  EXPECT_EQ(vispline::quoted(std::string(100'000, 'x')), "'" + std::string(200, 'x') + "...'");
}

}  // namespace
}  // namespace vispline
