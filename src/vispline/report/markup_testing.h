/// A strict reader of the XML subset that this folder writes, for tests: it throws on whatever it does not expect.
#pragma once

#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace vispline::report {

struct ParsedElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< directly inside, children left out
};

class MarkupReader {
 public:
  explicit MarkupReader(std::string_view text) : rest_(text) {
    if (rest_.starts_with("<!DOCTYPE html>")) rest_.remove_prefix(15);
    while (!rest_.empty()) step();
    if (!open_.empty()) throw std::runtime_error("never closed: " + elements[open_.back()].name);
  }
  /// In the order of their opening tags.
  std::vector<ParsedElement> elements;

  /// Names of elements and attributes only: what a page is made of, whatever it says.
  std::vector<std::string> shape() const {
    std::vector<std::string> out;
    for (const auto& e : elements) {
      std::string line = e.name;
      for (const auto& [name, value] : e.attributes) line += " " + name;
      out.push_back(line);
    }
    return out;
  }
  std::vector<ParsedElement> named(std::string_view name) const {
    std::vector<ParsedElement> out;
    for (const auto& e : elements) {
      if (e.name == name) out.push_back(e);
    }
    return out;
  }

 private:
  void step() {
    if (rest_.front() != '<') return read_text();
    if (rest_.starts_with("</")) return read_end();
    read_start();
  }
  void read_text() {
    const std::string text = decoded(take_until('<'));
    if (!open_.empty()) elements[open_.back()].text += text;
    if (open_.empty() && text.find_first_not_of('\n') != std::string::npos) throw std::runtime_error("text: " + text);
  }
  void read_end() {
    rest_.remove_prefix(2);
    const std::string name(take_until('>'));
    rest_.remove_prefix(1);
    if (open_.empty() || elements[open_.back()].name != name) throw std::runtime_error("unexpected end of " + name);
    open_.pop_back();
  }
  void read_start() {
    rest_.remove_prefix(1);
    elements.push_back({take_name(), {}, ""});
    while (rest_.starts_with(' ')) read_attribute();
    const bool is_empty = rest_.starts_with("/>");
    if (!is_empty && !rest_.starts_with('>')) throw std::runtime_error("tag of " + elements.back().name);
    rest_.remove_prefix(is_empty ? 2 : 1);
    if (!is_empty) open_.push_back(elements.size() - 1);
  }
  void read_attribute() {
    rest_.remove_prefix(1);
    const std::string name = take_name();
    if (!rest_.starts_with("=\"")) throw std::runtime_error("attribute " + name);
    rest_.remove_prefix(2);
    const std::string value = decoded(take_until('"'));
    rest_.remove_prefix(1);
    if (!elements.back().attributes.emplace(name, value).second) throw std::runtime_error("twice: " + name);
  }
  std::string take_name() {
    const std::size_t end = rest_.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-");
    if (end == 0 || end == std::string_view::npos) throw std::runtime_error("no name");
    const std::string name(rest_.substr(0, end));
    rest_.remove_prefix(end);
    return name;
  }
  std::string_view take_until(char stop) {
    const std::size_t end = std::min(rest_.find(stop), rest_.size());
    const std::string_view taken = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return taken;
  }
  static std::string decoded(std::string_view text) {
    static const std::map<std::string, char, std::less<>> kEntities{
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
    std::string out;
    while (!text.empty()) {
      if (text.front() == '<') throw std::runtime_error("raw <");
      if (text.front() != '&') {
        out += text.front();
        text.remove_prefix(1);
        continue;
      }
      const std::string_view entity = text.substr(0, text.find(';') + 1);
      out += kEntities.at(std::string(entity));
      text.remove_prefix(entity.size());
    }
    return out;
  }

  std::string_view rest_;
  std::vector<std::size_t> open_;
};

/// Strings that try to become markup, to hide or to break UTF-8; never empty.
inline std::string hostile_text(std::mt19937& generator) {
  static const std::vector<std::string> kPieces{"</script>",
                                                "<script>alert(1)</script>",
                                                "\" onload=\"x",
                                                "' style='x",
                                                "-->",
                                                "<!--",
                                                "]]>",
                                                "&",
                                                "&lt;",
                                                "&#0;",
                                                "\xE2\x80\xAE",
                                                "\xE2\x81\xA6",
                                                "\xEF\xBB\xBF",
                                                "\xE2\x80\xA8",
                                                "\xC0\xBC",
                                                "\xED\xA0\x80",
                                                "\xF4\x90\x80\x80",
                                                "\xFF",
                                                "\xC3",
                                                "</style>",
                                                "</title>",
                                                "{{7*7}}",
                                                "javascript:x",
                                                "\t",
                                                "\r\n",
                                                "\x1B[2J",
                                                "µ",
                                                "日本",
                                                "a",
                                                " ",
                                                "\\"};
  std::string text = "x";
  const auto count = 1 + generator() % 8;
  for (unsigned i = 0; i < count; ++i) {
    text += generator() % 4 == 0 ? std::string(1, static_cast<char>(generator() % 256))
                                 : kPieces[generator() % kPieces.size()];
  }
  return text;
}

}  // namespace vispline::report
