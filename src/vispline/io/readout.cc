#include "vispline/io/readout.h"

#include <algorithm>
#include <vector>

#include "vispline/bags/input.h"
#include "vispline/io/gopro.h"
#include "vispline/io/row_stream.h"
#include "vispline/io/text_layout.h"
#include "vispline/io/text_lines.h"

namespace vispline {
namespace {

constexpr std::string_view kMarsColumn = "Frame readout time[nanosec]";
constexpr double kLongest = 1.0;  // s; no sensor takes as long

std::optional<Readout> usable(double seconds, std::string_view source) {
  if (!(seconds > 0.0 && seconds < kLongest)) return std::nullopt;
  return Readout{seconds, std::string(source)};
}

std::optional<Readout> of_gcsv(const TextLayout& layout) {
  const auto note = layout.notes.find("frame_readout_time");
  double milliseconds = 0.0;
  if (note == layout.notes.end() || parse_double(note->second, milliseconds) != NumberStatus::kOk) return std::nullopt;
  return usable(1e-3 * milliseconds, "frame_readout_time");
}

/// The median: single frames report nothing or a wrong time.
std::optional<Readout> of_mars(ReadContext& context, TextLines& lines, const TextLayout& layout) {
  const auto column = std::find(layout.header.begin(), layout.header.end(), kMarsColumn);
  if (column == layout.header.end()) return std::nullopt;
  const WantedColumns wanted{.values = {static_cast<int>(column - layout.header.begin())}};
  lines.start_at(layout.data_begin, layout.data_line);
  RowStream rows(context, lines, layout, wanted);
  std::vector<double> nanoseconds;
  for (TextRow row; rows.next(row);) {
    if (row.values[0] > 0.0) nanoseconds.push_back(row.values[0]);
  }
  if (nanoseconds.empty()) return std::nullopt;
  const auto middle = nanoseconds.begin() + static_cast<std::ptrdiff_t>(nanoseconds.size() / 2);
  std::nth_element(nanoseconds.begin(), middle, nanoseconds.end());
  return usable(1e-9 * *middle, kMarsColumn);
}

}  // namespace

std::optional<Readout> read_readout(const std::string& path) {
  {
    const Input input = Input::open(path);
    if (gopro::recognizes(as_bytes(input.head(16)))) {
      const auto found = gopro::readout(input);
      return found ? usable(found->seconds, found->source) : std::nullopt;
    }
  }
  ReadContext context(path, "frames", {});
  TextLines lines(context);
  const TextLayout layout = find_layout(context, lines.head(kHeadRows));
  if (!layout.notes.empty()) return of_gcsv(layout);
  return of_mars(context, lines, layout);
}

}  // namespace vispline
