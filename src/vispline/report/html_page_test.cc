#include "vispline/report/html_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "vispline/core/error.h"
#include "vispline/report/escape.h"
#include "vispline/report/html_style.h"
#include "vispline/report/markup_testing.h"
#include "vispline/report/sha256.h"

namespace vispline::report {
namespace {

Plot plot_named(const std::string& name, double value) {
  Plot plot;
  plot.title = plot.x_label = plot.y_label = name;
  Series series;
  series.name = name;
  series.x = {0.0, 1.0, 2.0};
  series.y = {0.0, value, 1.0};
  plot.series = {series};
  return plot;
}

/// A page with every kind of block, in which all text is `name`.
Page page_of(const std::string& name, double value, int sections = 4) {
  Table table{
      name, {{name, "", false, 4}, {name, name, true, 4}, {name, name, true, 4}}, {{name, value, std::int64_t{7}}}};
  Figure pair{{plot_named(name, value), plot_named(name, value)}, name};
  Section section{name,
                  {Paragraph{name}, Cards{{{value, name, name, 4}}}, table, Figure{{plot_named(name, value)}, name},
                   pair, Preformatted{name}}};
  Page page{name, name, {}, {name, 42, name}};
  page.sections.assign(static_cast<std::size_t>(sections), section);
  return page;
}

MarkupReader read_back(const Page& page) { return MarkupReader(render(page)); }

TEST(HtmlPage, HostileTextNeverBecomesMarkup) {
  const auto plain = read_back(page_of("plain", 0.5, 1)).shape();
  std::mt19937 generator(31);
  for (int i = 0; i < 200; ++i) {
    const std::string text = hostile_text(generator);
    const MarkupReader read = read_back(page_of(text, 0.5, 1));
    ASSERT_EQ(read.shape(), plain) << visible_text(text);
    EXPECT_EQ(read.named("h1").at(0).text, visible_text(text));
    EXPECT_EQ(read.named("code").at(0).text, visible_text(text));
  }
}

TEST(HtmlPage, HoldsNoScriptAndAsksForNothing) {
  const MarkupReader read = read_back(page_of("<script src=x>", 0.5));
  const std::set<std::string> forbidden{"script", "iframe", "object", "embed", "form", "img", "use", "image", "base"};
  for (const auto& e : read.elements) {
    EXPECT_FALSE(forbidden.contains(e.name)) << e.name;
    for (const auto& [name, value] : e.attributes) {
      EXPECT_FALSE(name.starts_with("on") || name == "style" || name == "src") << name;
      EXPECT_TRUE(name != "href" || value.starts_with("#s") || value == "data:,") << value;
    }
  }
}

TEST(HtmlPage, ThePolicyNamesTheDigestOfTheStyleInThePage) {
  const MarkupReader read = read_back(page_of("x", 0.5));
  ASSERT_EQ(read.named("style").size(), 1U);
  const std::string digest = base64(sha256(read.named("style")[0].text));
  std::string policy;
  for (const auto& meta : read.named("meta")) {
    if (meta.attributes.contains("http-equiv")) policy = meta.attributes.at("content");
  }
  EXPECT_EQ(policy, "default-src 'none'; style-src 'sha256-" + digest + "'; img-src data:");
}

TEST(HtmlPage, TheStyleIsPlainText) {
  EXPECT_EQ(page_style().find_first_of("<&"), std::string_view::npos);  // means the same in HTML and to the reader here
  for (const char* request : {"url(", "@import", "expression"})
    EXPECT_EQ(page_style().find(request), std::string::npos);
}

TEST(HtmlPage, ValuesThatAreNotNumbersReadAsADash) {
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const MarkupReader read = read_back(page_of("x", value, 1));
    EXPECT_EQ(read.named("td").at(0).text, "—");
    EXPECT_EQ(read.named("td").at(1).text, "7");
    EXPECT_EQ(read.named("b").at(0).text.substr(0, 3), "—");
  }
}

TEST(HtmlPage, LinesToCopyKeepTheirLineEndsAndTabs) {
  Page page = page_of("x", 1.0, 1);
  page.sections[0].blocks = {Preformatted{"a\tb\n<i>\x1b\n\nend"}};
  EXPECT_EQ(read_back(page).named("pre").at(0).text, "a\tb\n<i>\\u001B\n\nend");
  page.sections[0].blocks = {Preformatted{"\n"}, Preformatted{""}};
  EXPECT_EQ(read_back(page).named("pre").at(0).text, "\n");
  EXPECT_EQ(read_back(page).named("pre").at(1).text, "");
}

TEST(HtmlPage, TablesNameTheirRowsAndColumns) {
  const MarkupReader read = read_back(page_of("x", 0.123456, 1));
  const auto heads = read.named("th");
  ASSERT_EQ(heads.size(), 4U);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(heads[static_cast<std::size_t>(i)].attributes.at("scope"), "col");
  EXPECT_EQ(heads[3].attributes.at("scope"), "row");
  EXPECT_EQ(read.named("td").at(0).text, "0.1235");
  EXPECT_EQ(read.named("td").at(0).attributes.at("class"), "num");
}

TEST(HtmlPage, ContentsComeWithMoreThanThreeSections) {
  EXPECT_TRUE(read_back(page_of("x", 1.0, 3)).named("nav").empty());
  const MarkupReader read = read_back(page_of("x", 1.0, 4));
  ASSERT_EQ(read.named("a").size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read.named("a")[i].attributes.at("href"), "#" + read.named("section")[i].attributes.at("id"));
  }
}

TEST(HtmlPage, ASinglePlotIsDrawnForWideAndNarrowScreens) {
  const MarkupReader read = read_back(page_of("x", 1.0, 1));
  std::vector<std::string> screens;
  for (const auto& div : read.named("div")) {
    const std::string kind = div.attributes.at("class");
    if (kind == "wide" || kind == "narrow" || kind == "any") screens.push_back(kind);
  }
  EXPECT_EQ(screens, (std::vector<std::string>{"wide", "narrow", "any", "any"}));
}

TEST(HtmlPage, FooterTellsHowToMakeItAgain) {
  Page page = page_of("x", 1.0);
  page.provenance = {"1.2.3", 18446744073709551615ULL, "vispline demo --out \"a b\""};
  const MarkupReader read = read_back(page);
  EXPECT_EQ(read.named("code").at(0).text, "vispline demo --out \"a b\"");
  EXPECT_NE(render(page).find("vispline 1.2.3 · seed 18446744073709551615"), std::string::npos);
  page.provenance = {"1.2.3", std::nullopt, ""};
  EXPECT_EQ(render(page).find("seed"), std::string::npos);
  EXPECT_TRUE(read_back(page).named("code").empty());
}

TEST(HtmlPage, SameBytesForTheSamePage) { EXPECT_EQ(render(page_of("x", 0.3)), render(page_of("x", 0.3))); }

TEST(HtmlPage, RefusesRowsThatDoNotFit) {
  Page page = page_of("x", 1.0, 1);
  std::get<Table>(page.sections[0].blocks[2]).rows[0].pop_back();
  EXPECT_THROW(render(page), Error);
  EXPECT_NO_THROW(render(Page{}));
}

}  // namespace
}  // namespace vispline::report
