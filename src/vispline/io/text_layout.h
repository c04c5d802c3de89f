/// How a text table is written, found from its first lines: separator, decimal mark, header, number of columns.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "vispline/io/read_context.h"

namespace vispline {

struct TextLayout {
  char separator = ',';  ///< ' ': any run of blanks and tabs
  char decimal = '.';
  std::vector<std::string> header;  ///< column names as written; empty if there are none
  bool header_in_comment = false;   ///< the names stood in a comment line
  /// Lines `key,value` between a first line that announces them (Gyroflow's) and the header; empty in other files.
  std::map<std::string, std::string> notes;
  std::size_t fields = 0;                        ///< cells of a data row
  std::size_t data_begin = 0;                    ///< offset of the first data row
  std::int64_t data_line = 1;                    ///< its line number, from 1
  std::vector<std::vector<std::string>> sample;  ///< cells of the first rows
};

/// Rows of the head that find_layout wants to see, if the file has so many.
inline constexpr std::size_t kHeadRows = 64;

/// Looks at the first rows of `text` (line ends already LF, no byte order mark), which is the whole file or ends with a
/// line end. Throws E-EMPTY if there is no data
/// row, E-DECIMAL for decimal commas that nothing allows, E-COLUMNS if header and rows disagree, E-LIMIT.
TextLayout find_layout(ReadContext& context, std::string_view text);

}  // namespace vispline
