/// How far apart two names are, to name the one that was meant.
#pragma once

#include <cstddef>
#include <string_view>

namespace vispline {

/// Letters to insert, remove or replace (Levenshtein); a.size() * b.size() steps.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace vispline
