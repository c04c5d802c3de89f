#include "vispline/io/read_context.h"

#include <algorithm>
#include <utility>

#include "vispline/io/number_text.h"

namespace vispline {

ReadContext::ReadContext(std::string path, std::string noun, ReadOptions options)
    : path_(std::move(path)), noun_(std::move(noun)), options_(std::move(options)) {}

void ReadContext::warn(std::string code, std::string message, std::string where, std::string effect, std::string next) {
  diagnostics.add({.code = std::move(code),
                   .message = std::move(message),
                   .where = std::move(where),
                   .effect = std::move(effect),
                   .next = std::move(next)});
}

void ReadContext::drop(const std::string& code, std::string message, std::string where) {
  ++counts.dropped[code];
  warn(code, std::move(message), std::move(where), "this row is left out");
}

void ReadContext::fail(ExitCode exit_code, std::string code, std::string message, std::string where,
                       std::string next) const {
  throw Error(exit_code, {.code = std::move(code),
                          .message = std::move(message),
                          .where = std::move(where),
                          .effect = "nothing written; " + std::to_string(counts.read) + " rows read",
                          .next = std::move(next)});
}

double ReadContext::share(std::int64_t rows) const {
  return static_cast<double>(rows) / static_cast<double>(std::max<std::int64_t>(counts.read, 1));
}

std::string percent(double share) { return brief(100.0 * share) + " %"; }

}  // namespace vispline
