#include "vispline/report/markup.h"

#include <cassert>
#include <utility>

#include "vispline/report/escape.h"

namespace vispline::report {

void Markup::begin(std::string_view tag, Attributes attributes) {
  out_.append("<").append(tag);
  for (const Attribute& a : attributes) out_.append(" ").append(a.name).append("=\"").append(escaped(a.value)) += '"';
}

Markup& Markup::open(std::string_view tag, Attributes attributes) {
  begin(tag, attributes);
  out_ += '>';
  open_.emplace_back(tag);
  return *this;
}

Markup& Markup::close() {
  assert(!open_.empty());
  out_.append("</").append(open_.back()) += '>';
  open_.pop_back();
  return *this;
}

Markup& Markup::empty(std::string_view tag, Attributes attributes) {
  begin(tag, attributes);
  out_ += "/>";
  return *this;
}

Markup& Markup::text(std::string_view untrusted) {
  out_ += escaped(untrusted);
  return *this;
}

Markup& Markup::element(std::string_view tag, std::string_view untrusted, Attributes attributes) {
  return open(tag, attributes).text(untrusted).close();
}

Markup& Markup::newline() {
  out_ += '\n';
  return *this;
}

Markup& Markup::verbatim(std::string_view trusted) {
  out_ += trusted;
  return *this;
}

std::string Markup::result() && {
  assert(open_.empty());
  return std::move(out_);
}

}  // namespace vispline::report
