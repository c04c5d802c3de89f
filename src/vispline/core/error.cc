#include "vispline/core/error.h"

#include <algorithm>
#include <cstdio>

namespace vispline {
namespace {
constexpr std::int64_t kMaxExamples = 3;
constexpr std::size_t kMaxQuotedBytes = 200;

/// Control bytes as \xNN: no text can move the cursor of a terminal or forge a line of a log.
std::string printable(std::string_view raw) {
  std::string text;
  for (const unsigned char c : raw) {
    if (c >= 0x20 && c != 0x7f) {
      text += static_cast<char>(c);
      continue;
    }
    char escaped[5];
    std::snprintf(escaped, sizeof escaped, "\\x%02X", static_cast<unsigned>(c));
    text += escaped;
  }
  return text;
}
}  // namespace

std::string to_text(const Diagnostic& diagnostic) {
  const bool is_error = diagnostic.code.starts_with("E-");
  std::string text =
      std::string(is_error ? "error[" : "warning[") + diagnostic.code + "]: " + printable(diagnostic.message);
  if (!diagnostic.where.empty()) text += "\n  where:  " + printable(diagnostic.where);
  if (!diagnostic.effect.empty()) text += "\n  effect: " + printable(diagnostic.effect);
  if (!diagnostic.next.empty()) text += "\n  next:   " + printable(diagnostic.next);
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
  return "'" + printable(untrusted.substr(0, kMaxQuotedBytes)) + (untrusted.size() > kMaxQuotedBytes ? "...'" : "'");
}

}  // namespace vispline
