#include "vispline/core/error.h"

#include <algorithm>
#include <cstdio>

namespace vispline {
namespace {
constexpr std::int64_t kMaxExamples = 3;
constexpr std::size_t kMaxQuotedBytes = 200;
}  // namespace

std::string to_text(const Diagnostic& diagnostic) {
  const bool is_error = diagnostic.code.starts_with("E-");
  std::string text = std::string(is_error ? "error[" : "warning[") + diagnostic.code + "]: " + diagnostic.message;
  if (!diagnostic.where.empty()) text += "\n  where:  " + diagnostic.where;
  if (!diagnostic.effect.empty()) text += "\n  effect: " + diagnostic.effect;
  if (!diagnostic.next.empty()) text += "\n  next:   " + diagnostic.next;
  return text;
}

Error::Error(ExitCode exit_code, Diagnostic diagnostic)
    : exit_code_(exit_code), diagnostic_(std::move(diagnostic)), text_(to_text(diagnostic_)) {}

void require(bool condition, std::string_view expected) {
  if (condition) return;
  throw Error(ExitCode::kUsage, {.code = "E-ARGUMENT",
                                 .message = "expected " + std::string(expected),
                                 .where = "",
                                 .effect = "nothing done",
                                 .next = ""});
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (++counts_[diagnostic.code] <= kMaxExamples) examples_.push_back(std::move(diagnostic));
}

void Diagnostics::merge(const Diagnostics& other) {
  std::map<std::string, std::int64_t> unseen = other.counts_;
  for (const Diagnostic& example : other.examples_) {
    add(example);
    --unseen[example.code];
  }
  for (const auto& [code, count] : unseen) counts_[code] += count;
}

std::int64_t ReadCounts::dropped_total() const {
  std::int64_t total = 0;
  for (const auto& [code, count] : dropped) total += count;
  return total;
}

std::string quoted(std::string_view untrusted) {
  std::string text = "'";
  for (const unsigned char c : untrusted.substr(0, kMaxQuotedBytes)) {
    if (c >= 0x20 && c != 0x7f) {
      text += static_cast<char>(c);
      continue;
    }
    char escaped[5];
    std::snprintf(escaped, sizeof escaped, "\\x%02X", static_cast<unsigned>(c));
    text += escaped;
  }
  return text + (untrusted.size() > kMaxQuotedBytes ? "...'" : "'");
}

}  // namespace vispline
