#include "vispline/report/escape.h"

#include <gtest/gtest.h>

#include "vispline/report/markup.h"
#include "vispline/report/markup_testing.h"

namespace vispline::report {
namespace {

TEST(VisibleText, LeavesOrdinaryTextAlone) {
  for (const std::string text : {"", "gyro x [rad/s]", "µ σ(τ) √Hz", "日本語", "👍", "C:\\logs\\a.csv"}) {
    EXPECT_EQ(visible_text(text), text);
  }
}

TEST(VisibleText, ShowsWhatHides) {
  EXPECT_EQ(visible_text(std::string_view("a\0b", 3)), "a\\u0000b");
  EXPECT_EQ(visible_text("a\nb\x7F"), "a\\u000Ab\\u007F");
  EXPECT_EQ(visible_text("\xC2\x85"), "\\u0085");
  EXPECT_EQ(visible_text("exe.\xE2\x80\xAEgnp"), "exe.\\u202Egnp");
  EXPECT_EQ(visible_text("\xE2\x81\xA6\xE2\x80\xA8\xEF\xBB\xBF"), "\\u2066\\u2028\\uFEFF");
  EXPECT_EQ(visible_text("\xF3\xA0\x81\x81"), "\\uE0041");
}

TEST(VisibleText, ShowsBytesThatAreNotUtf8) {
  EXPECT_EQ(visible_text("\xFFz"), "\\xFFz");
  EXPECT_EQ(visible_text("\xC0\xBC"), "\\xC0\\xBC");                    // an overlong '<'
  EXPECT_EQ(visible_text("\xE0\x80\xBC"), "\\xE0\\x80\\xBC");           // and another
  EXPECT_EQ(visible_text("\xED\xA0\x80"), "\\xED\\xA0\\x80");           // a surrogate
  EXPECT_EQ(visible_text("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");  // beyond U+10FFFF
  EXPECT_EQ(visible_text("\xE2\x80"), "\\xE2\\x80");                    // cut off
  EXPECT_EQ(visible_text("\xE2\x28\xA1"), "\\xE2(\\xA1");
}

TEST(Escaped, FiveCharactersAreEntities) { EXPECT_EQ(escaped("<a b=\"c\">&'"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;"); }

TEST(Escaped, HostileTextStaysTextInElementsAndAttributes) {
  std::mt19937 generator(7);
  for (int i = 0; i < 2000; ++i) {
    const std::string text = hostile_text(generator);
    EXPECT_EQ(visible_text(visible_text(text)), visible_text(text));
    Markup markup;
    markup.element("p", text, {{"title", text}});
    const MarkupReader read(std::move(markup).result());
    ASSERT_EQ(read.elements.size(), 1U);
    EXPECT_EQ(read.elements[0].text, visible_text(text));
    EXPECT_EQ(read.elements[0].attributes.at("title"), visible_text(text));
  }
}

TEST(Shortened, KeepsWhatFitsAndCutsBetweenCharacters) {
  EXPECT_EQ(shortened("gyro", 10.0), "gyro");
  std::mt19937 generator(8);
  for (int i = 0; i < 500; ++i) {
    const std::string text = hostile_text(generator) + hostile_text(generator);
    for (const double width : {0.0, 0.5, 1.0, 3.0, 8.0}) {
      const std::string cut = shortened(text, width);
      EXPECT_LE(text_width_em(cut), width);
      EXPECT_EQ(visible_text(cut), cut);
      const bool whole = cut == visible_text(text);
      EXPECT_TRUE(whole || cut.empty() || cut.ends_with("…")) << cut;
    }
  }
}

TEST(MarkupReader, RefusesBrokenMarkup) {
  for (const std::string text :
       {"<p>", "<p></q>", "<p a=b></p>", "<p>&x;</p>", "<p a=\"<\"></p>", "x", "<p a=\"1\" a=\"2\"/>"}) {
    EXPECT_ANY_THROW(MarkupReader{text}) << text;
  }
  EXPECT_EQ(MarkupReader("<p a=\"1\">x<br/></p>").shape(), (std::vector<std::string>{"p a", "br"}));
}

}  // namespace
}  // namespace vispline::report
