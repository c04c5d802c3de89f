/// Writes HTML and SVG so that every element closes and every text and attribute value goes through escaped().
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/report/number.h"

namespace vispline::report {

/// An attribute's name is a literal of the program; its value may come from anywhere.
struct Attribute {
  Attribute(std::string_view name_in, std::string_view value_in) : name(name_in), value(value_in) {}
  Attribute(std::string_view name_in, double number) : name(name_in), value(coordinate(number)) {}
  std::string_view name;
  std::string value;
};

class Markup {
 public:
  using Attributes = std::initializer_list<Attribute>;

  Markup& open(std::string_view tag, Attributes attributes = {});
  Markup& close();
  /// An element without content, `<tag ... />`; only for void elements of HTML and for SVG.
  Markup& empty(std::string_view tag, Attributes attributes = {});
  Markup& text(std::string_view untrusted);
  Markup& element(std::string_view tag, std::string_view untrusted, Attributes attributes = {});
  Markup& newline();
  /// Appends as it stands: for the constants of this folder and for another Markup's result, never for input.
  Markup& verbatim(std::string_view trusted);
  /// Precondition: every opened element is closed.
  std::string result() &&;

 private:
  void begin(std::string_view tag, Attributes attributes);
  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace vispline::report
