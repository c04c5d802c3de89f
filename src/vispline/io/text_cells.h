/// Lines and cells of a text table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vispline {

/// CRLF and lone CR become LF, in place.
void normalise_line_ends(std::string& text);

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// Without the double quotes around it, if there are any.
std::string_view unquoted(std::string_view cell);

/// Nothing but blanks, or a comment that starts with # or %.
bool is_comment(std::string_view line);

/// The cells of a line, trimmed and unquoted. `separator` ' ' stands for any run of blanks and tabs; separators inside
/// double quotes do not count. Stops one cell after limits::kFields.
std::vector<std::string_view> split_cells(std::string_view line, char separator);

/// The line that starts at `pos`, without its line end.
std::string_view line_at(std::string_view text, std::size_t pos);

/// A number, nan, inf or nothing at all; `decimal` is the decimal mark.
bool is_numeric(std::string_view cell, char decimal);

}  // namespace vispline
