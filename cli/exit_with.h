/// Ends the process with a code after everything was said.
#pragma once

namespace vispline::cli {

struct ExitWith {
  int code;
};

}  // namespace vispline::cli
