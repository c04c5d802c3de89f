#include "vispline/io/read_end.h"

#include <string>

namespace vispline {

void fail_none_left(const ReadContext& context) {
  context.fail(ExitCode::kInput, "E-EMPTY",
               "no " + context.noun() + " are left of " + std::to_string(context.counts.read) + " rows", context.path(),
               "check that the recording was written");
}

void check_strict(const ReadContext& context) {
  if (!context.options().strict || context.diagnostics.empty()) return;
  const Diagnostic& first = context.diagnostics.examples().front();
  const bool unfit = first.code == "W-NONFINITE" || first.code == "W-UNITS" || first.code == "W-CONSTANT" ||
                     first.code == "W-SATURATED" || first.code == "W-SPIKE";
  context.fail(unfit ? ExitCode::kUnfit : ExitCode::kInput, "E-" + first.code.substr(2), first.message, first.where,
               "leave out --strict to go on with a warning");
}

}  // namespace vispline
