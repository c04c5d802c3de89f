/// Pieces of text that the writers of parameter files share. The same bytes in every locale.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vispline/calibration/noise_entry.h"

namespace vispline::dialect {

/// Shortest digits that read back to the same double, always with a point and a signed exponent: 460.0, 1.0e-05. YAML
/// 1.1 readers take 460 for an integer and 1e-05 for a string. Precondition: finite.
std::string yaml_float(double value);
/// 17 digits as OpenCV writes them: 1.0922514245261136e-04.
std::string opencv_float(double value);
/// For a comment or a message: six significant digits.
std::string brief(double value);
/// A scalar that every YAML reader takes for this text: as it is if it is a word, else in double quotes with escapes.
std::string yaml_string(std::string_view text);
/// At most 64 letters, digits, '_' and '-' of `name`, '_' for anything else; "imu" if nothing is left.
std::string slug(std::string_view name);

/// `indent``key`: value  # comment
std::string value_line(std::string_view indent, std::string_view key, const std::string& value,
                       std::string_view comment);

/// The line of a walk: its value, else its upper bound, else a comment that says that it is missing. The unit ends the
/// line. `factor` converts to what the file holds; `note` gets a sentence for the last two cases.
struct WalkLine {
  std::string indent, key, unit;
  double factor = 1.0;
};
std::string walk_line(const WalkLine& line, const WalkEntry& walk, std::vector<std::string>& notes);
/// What the file holds for `walk`: its value, else its upper bound.
std::optional<double> written_walk(const WalkEntry& walk);
/// The sentence for a walk without a value.
std::string walk_note(std::string_view key, const WalkEntry& walk);

}  // namespace vispline::dialect
