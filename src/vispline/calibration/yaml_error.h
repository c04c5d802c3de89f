/// The errors of the YAML reader.
#pragma once

#include <string>

#include "vispline/core/error.h"

namespace vispline {

[[noreturn]] inline void fail_yaml(const std::string& message, const std::string& where, const std::string& next = "") {
  throw Error(ExitCode::kUsage,
              {.code = "E-YAML", .message = message, .where = where, .effect = "nothing read", .next = next});
}

[[noreturn]] inline void fail_config(const std::string& message, const std::string& where,
                                     const std::string& next = "") {
  throw Error(ExitCode::kUsage,
              {.code = "E-CONFIG", .message = message, .where = where, .effect = "nothing read", .next = next});
}

[[noreturn]] inline void fail_yaml_limit(const std::string& message, const std::string& where) {
  throw Error(ExitCode::kLimit,
              {.code = "E-LIMIT", .message = message, .where = where, .effect = "nothing read", .next = ""});
}

}  // namespace vispline
