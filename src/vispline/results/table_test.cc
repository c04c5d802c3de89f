#include "vispline/results/table.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>

#include "vispline/core/error.h"

namespace vispline {
namespace {

TEST(Table, AlignsColumns) {
  Table table({{"method", Table::Align::kLeft}, {"error [m]"}, {"note", Table::Align::kLeft}});
  table.add_row({"rk4", "0.00125", "µ"});
  table.add_row({"a very long name", "12", ""});
  EXPECT_EQ(table.text(),
            "method            error [m]  note\n"
            "----------------  ---------  ----\n"
            "rk4                 0.00125  µ\n"
            "a very long name         12\n");
}

TEST(Table, WideCellsOfManyBytesCountAsCharacters) {
  Table table({{"a"}, {"b"}});
  table.add_row({"µµµ", "1"});
  EXPECT_EQ(table.text(), "  a  b\n---  -\nµµµ  1\n");
}

TEST(Table, RowsMustFit) {
  Table table({{"a"}, {"b"}});
  EXPECT_THROW(table.add_row({"1"}), Error);
  EXPECT_EQ(table.text(), "a  b\n-  -\n");
}

TEST(NumberText, SignificantDigitsInEveryLocale) {
  const char* before = std::setlocale(LC_NUMERIC, nullptr);
  const std::string saved = before;
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");  // without effect where it is not installed
  EXPECT_EQ(number_text(0.57664321, 4), "0.5766");
  EXPECT_EQ(number_text(1234.0, 6), "1234");
  EXPECT_EQ(number_text(1.25e-9, 4), "1.25e-09");
  EXPECT_EQ(number_text(-0.5, 4), "-0.5");
  std::setlocale(LC_NUMERIC, saved.c_str());
}

TEST(NumberText, AbsentNumbersAreADash) {
  EXPECT_EQ(number_text(std::nan(""), 4), "-");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity(), 4), "-");
  EXPECT_EQ(number_text(std::optional<double>(), 4), "-");
  EXPECT_EQ(number_text(std::optional<double>(2.5), 4), "2.5");
}

}  // namespace
}  // namespace vispline
