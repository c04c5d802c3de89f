/// How far the reading of a file is, on stderr; polls for interrupts.
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "console.h"
#include "vispline/io/text_lines.h"

namespace vispline::cli {

inline ReadProgress reading_progress(const std::string& what) {
  struct State {
    std::unique_ptr<Progress> bar;
    std::uint64_t done = 0;
  };
  return [what, state = std::make_shared<State>()](std::uint64_t done, std::uint64_t total) {
    if (!state->bar) state->bar = std::make_unique<Progress>(what, total);
    state->bar->add(done - std::min(done, state->done));
    state->done = done;
  };
}

}  // namespace vispline::cli
