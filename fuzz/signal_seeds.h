/// Seeds of the targets that read signals and parameter files.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vispline::fuzz {

/// "target/name" and its bytes.
std::vector<std::pair<std::string, std::string>> signal_seeds();

}  // namespace vispline::fuzz
