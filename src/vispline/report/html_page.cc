#include "vispline/report/html_page.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>

#include "vispline/core/error.h"
#include "vispline/report/html_style.h"
#include "vispline/report/markup.h"
#include "vispline/report/svg_plot.h"

namespace vispline::report {
namespace {

constexpr double kWidePx = 790.0;
constexpr double kNarrowPx = 390.0;
constexpr std::size_t kSectionsWithoutContents = 3;

std::string section_id(std::size_t index) { return joined({"s", std::to_string(index + 1)}); }

void write_head(const Page& page, Markup& html) {
  html.verbatim("<!DOCTYPE html>\n").open("html", {{"lang", "en"}}).newline().open("head").newline();
  html.empty("meta", {{"charset", "utf-8"}}).newline();
  html.empty("meta", {{"http-equiv", "Content-Security-Policy"}, {"content", content_security_policy()}}).newline();
  html.empty("meta", {{"name", "viewport"}, {"content", "width=device-width, initial-scale=1"}}).newline();
  html.empty("link", {{"rel", "icon"}, {"href", "data:,"}}).newline();
  html.element("title", page.title).newline();
  html.open("style").verbatim(page_style()).close().newline();
  html.close().newline();
}

void write_header(const Page& page, Markup& html) {
  html.open("header").newline().element("h1", page.title).newline();
  if (!page.subtitle.empty()) html.element("p", page.subtitle, {{"class", "subtitle"}}).newline();
  html.close().newline();
}

void write_contents(const Page& page, Markup& html) {
  if (page.sections.size() <= kSectionsWithoutContents) return;
  html.open("nav", {{"aria-label", "Contents"}}).open("ol").newline();
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    html.open("li").element("a", page.sections[i].heading, {{"href", joined({"#", section_id(i)})}}).close().newline();
  }
  html.close().close().newline();
}

void write(const Paragraph& paragraph, Markup& html) { html.element("p", paragraph.text).newline(); }

/// Line ends and tabs are markup of ours, whatever lies between them is text.
void write(const Preformatted& block, Markup& html) {
  html.open("pre");
  std::string_view rest = block.text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of("\n\t"), rest.size());
    html.text(rest.substr(0, end));
    if (end < rest.size()) html.verbatim(rest[end] == '\n' ? "\n" : "\t");
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  html.close().newline();
}

void write(const Cards& cards, Markup& html) {
  html.open("div", {{"class", "cards"}}).newline();
  for (const Card& card : cards.cards) {
    html.open("div", {{"class", "card"}}).open("b").text(significant(card.value, card.digits));
    if (!card.unit.empty()) html.text(" ").element("i", card.unit);
    html.close().element("span", card.label).close().newline();
  }
  html.close().newline();
}

std::string cell_text(const Cell& cell, int digits) {
  const auto text = [&](const auto& value) -> std::string {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::string>) return value;
    if constexpr (std::is_same_v<Value, double>) return significant(value, digits);
    if constexpr (std::is_same_v<Value, std::int64_t>) return std::to_string(value);
  };
  return std::visit(text, cell);
}

std::string_view alignment(const Column& column) { return column.numeric ? "num" : "txt"; }

void write_columns(const Table& table, Markup& html) {
  html.open("thead").open("tr").newline();
  for (const Column& column : table.columns) {
    html.open("th", {{"scope", "col"}, {"class", alignment(column)}}).text(column.header);
    if (!column.unit.empty()) html.element("span", column.unit);
    html.close().newline();
  }
  html.close().close().newline();
}

void write_row(const Table& table, const std::vector<Cell>& row, Markup& html) {
  require(row.size() == table.columns.size(), "as many cells as columns in each row of a table");
  html.open("tr");
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Column& column = table.columns[i];
    const std::string text = cell_text(row[i], column.digits);
    if (i == 0) {
      html.element("th", text, {{"scope", "row"}, {"class", alignment(column)}});
    } else {
      html.element("td", text, {{"class", alignment(column)}});
    }
  }
  html.close().newline();
}

void write(const Table& table, Markup& html) {
  html.open("div", {{"class", "scroll"}}).open("table").newline();
  if (!table.caption.empty()) html.element("caption", table.caption).newline();
  write_columns(table, html);
  html.open("tbody").newline();
  for (const auto& row : table.rows) write_row(table, row, html);
  html.close().close().close().newline();
}

void write_plot(const Plot& plot, double width_px, std::string_view screens, Markup& html) {
  html.open("div", {{"class", screens}}).newline().verbatim(render_svg(plot, width_px)).close().newline();
}

void write(const Figure& figure, Markup& html) {
  html.open("figure").open("div", {{"class", "plots"}}).newline();
  const bool single = figure.plots.size() == 1;
  if (single) write_plot(figure.plots[0], kWidePx, "wide", html);
  for (const Plot& plot : figure.plots) write_plot(plot, kNarrowPx, single ? "narrow" : "any", html);
  html.close();
  if (!figure.caption.empty()) html.element("figcaption", figure.caption);
  html.close().newline();
}

void write(const HeatMap& map, Markup& html) {
  html.open("figure")
      .newline()
      .open("div", {{"class", "scroll"}})
      .newline()
      .verbatim(render_svg(map))
      .close()
      .newline();
  if (!map.caption.empty()) html.element("figcaption", map.caption);
  html.close().newline();
}

void write_section(const Section& section, std::size_t index, Markup& html) {
  html.open("section", {{"id", section_id(index)}}).newline().element("h2", section.heading).newline();
  for (const Block& block : section.blocks) std::visit([&](const auto& b) { write(b, html); }, block);
  html.close().newline();
}

void write_footer(const Provenance& provenance, Markup& html) {
  html.open("footer").open("p").text(joined({"vispline ", provenance.version}));
  if (provenance.seed) html.text(joined({" · seed ", std::to_string(*provenance.seed)}));
  html.close().newline();
  if (!provenance.command.empty()) html.open("p").element("code", provenance.command).close().newline();
  html.close().newline();
}

}  // namespace

std::string render(const Page& page) {
  Markup html;
  write_head(page, html);
  html.open("body").newline();
  write_header(page, html);
  write_contents(page, html);
  html.open("main").newline();
  for (std::size_t i = 0; i < page.sections.size(); ++i) write_section(page.sections[i], i, html);
  html.close().newline();
  write_footer(page.provenance, html);
  html.close().newline().close().newline();
  return std::move(html).result();
}

}  // namespace vispline::report
