/// How the reading of any file ends.
#pragma once

#include "vispline/io/read_context.h"

namespace vispline {

/// E-EMPTY: no row is left.
[[noreturn]] void fail_none_left(const ReadContext& context);

/// `--strict`: throws the first warning as an error.
void check_strict(const ReadContext& context);

}  // namespace vispline
