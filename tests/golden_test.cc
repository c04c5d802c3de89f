// The comparison with golden files: it must see a wrong number and must not see a wider column.
#include "golden.h"

namespace vispline {
namespace {

constexpr const char* kTable =
    "method          rate [Hz]  final [m]\n"
    "--------------  ---------  ---------\n"
    "euler_course_2  200        0.57656\n"
    "rk4             1000       9.4836e-11\n";

std::string with(const std::string& what, const std::string& instead) {
  std::string text = kTable;
  return text.replace(text.find(what), what.size(), instead);
}

TEST(Golden, TellsNumbersFromNames) {
  const auto tokens = golden_detail::tokens_of("rk4 of x_2018: -1.5e-3, [2 m] 1.2.3 7");
  std::string numbers;
  for (const GoldenToken& token : tokens) numbers += token.number ? token.text + ";" : "";
  EXPECT_EQ(numbers, "-1.5e-3;2;7;");
}

TEST(Golden, AcceptsWhatRoundingCanDo) {
  EXPECT_EQ(golden_difference(kTable, kTable), "");
  EXPECT_EQ(golden_difference(kTable, with("0.57656", "0.57657")), "");
  EXPECT_EQ(golden_difference(kTable, with("9.4836e-11", "3.1e-12")), "");
  EXPECT_EQ(golden_difference(kTable, with("0.57656\n", "  0.57656\n\n")), "");
  EXPECT_EQ(golden_difference(kTable, with("---------\n", "------------\n")), "");
  EXPECT_EQ(golden_difference("x 1.00000012345", "x 1.0000002"), "");
  EXPECT_EQ(golden_difference("\"order\": 4.0", "\"order\": 4.004", {.by_word = {{"order", 0.01}}}), "");
}

TEST(Golden, SeesEveryPoisonedEntry) {
  EXPECT_EQ(golden_difference(kTable, with("0.57656", "0.57658")),
            "golden:  euler_course_2  200        0.57656\nprinted: euler_course_2  200        0.57658");
  for (const auto& [what, instead] :
       std::vector<std::pair<std::string, std::string>>{{"200", "201"},
                                                        {"euler", "Euler"},
                                                        {"course_2", "course_3"},
                                                        {"0.57656", "-0.57656"},
                                                        {"0.57656", "-"},
                                                        {"9.4836e-11", "9.4836e-9"},
                                                        {"[m]", "[mm]"},
                                                        {"rk4 ", "rk4 1"},
                                                        {"1000", "1000.5"},
                                                        {"euler_course_2  200        0.57656\n", ""}}) {
    EXPECT_NE(golden_difference(kTable, with(what, instead)), "") << what << " -> " << instead;
  }
  EXPECT_NE(golden_difference("\"rate\": 4.0", "\"rate\": 4.004", {.by_word = {{"order", 0.01}}}), "");
  EXPECT_NE(golden_difference("x 1.00000012345", "x 1.00002"), "");
  EXPECT_NE(golden_difference(kTable, ""), "");
}

}  // namespace
}  // namespace vispline
