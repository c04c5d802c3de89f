/// A report as one static HTML file: no script, no request to anywhere, nothing from the input that becomes markup.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vispline/report/heat_map.h"
#include "vispline/report/plot.h"

namespace vispline::report {

struct Paragraph {
  std::string text{};
};

/// Lines to copy out of the page as they stand: \n and \t stay what they are.
struct Preformatted {
  std::string text{};
};

/// A number to remember, set large.
struct Card {
  double value = 0.0;
  std::string unit{};  ///< may be empty
  std::string label{};
  int digits = 4;  ///< significant
};

struct Cards {
  std::vector<Card> cards{};
};

struct Column {
  std::string header{};
  std::string unit{};   ///< may be empty
  bool numeric = true;  ///< aligned at the right, in figures of one width
  int digits = 4;       ///< significant digits of double cells
};

/// A double that is not finite reads "—"; an integer is written in full.
using Cell = std::variant<std::string, double, std::int64_t>;

/// The first cell of a row names the row.
struct Table {
  std::string caption{};  ///< may be empty
  std::vector<Column> columns{};
  std::vector<std::vector<Cell>> rows{};  ///< as many cells as columns in each
};

/// One plot across the page, or several side by side where there is room.
/// The page sets their widths and draws a single plot a second time for narrow screens.
struct Figure {
  std::vector<Plot> plots{};
  std::string caption{};  ///< may be empty
};

using Block = std::variant<Paragraph, Preformatted, Cards, Table, Figure, HeatMap>;

struct Section {
  std::string heading{};
  std::vector<Block> blocks{};
};

/// What makes the report reproducible. No time, host or path of its own.
struct Provenance {
  std::string version{};
  std::optional<std::uint64_t> seed{};
  std::string command{};  ///< may be empty
};

struct Page {
  std::string title{};
  std::string subtitle{};           ///< may be empty
  std::vector<Section> sections{};  ///< more than three get a table of contents
  Provenance provenance{};
};

/// The file's text, UTF-8; the same bytes for the same page. Throws Error for a table whose rows do not fit its columns
/// and for plots that render_svg refuses.
std::string render(const Page& page);

}  // namespace vispline::report
