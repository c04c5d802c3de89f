/// The rows of a text table with their stamps in nanoseconds.
#pragma once

#include <optional>
#include <vector>

#include "vispline/io/column_plan.h"
#include "vispline/io/row_stream.h"
#include "vispline/io/stamp_rate.h"
#include "vispline/io/stamp_screen.h"

namespace vispline {

/// Where the stamps of a table come from: a column of times, two columns, counts of samples, or the number of the row.
struct StampPlan {
  int column = -1;
  int nano_column = -1;
  bool counts = false;                    ///< the stamp counts samples
  std::optional<TimeUnit> declared = {};  ///< by the format or the header: to be checked
  std::optional<TimeUnit> given = {};     ///< by a flag: taken as it is
  std::optional<SampleClock> clock = {};  ///< by the flag --rate
};

/// Throws E-TIME-UNIT if nothing says when the rows were taken, E-ARGUMENT (exit 2) for flags that contradict each
/// other or the file.
StampPlan plan_stamps(const ReadContext& context, const ColumnPlan& plan);

class TimedRows {
 public:
  /// `wanted` gets its columns of stamps from `stamps`. All must outlive this.
  TimedRows(ReadContext& context, TextLines& lines, const TextLayout& layout, const StampPlan& stamps,
            std::vector<int> values, std::size_t window = kWindowRows);

  /// The next well-formed row. Throws as RowStream::next and settle_time_unit do.
  bool next(SensorRow& row);

  /// The checks of settle_time_unit for all rows, where the first ones could not tell: after the last row, and after
  /// the screen has found the order of the rows to be good.
  void check_constant(const StampScreen& screen) const;
  void check_step(const StampScreen& screen) const;

  /// Nanoseconds that one unit of the file's stamps stands for.
  double unit_ns() const { return unit_ ? unit_->nanoseconds() : 1e9; }

 private:
  void settle();
  SensorRow timed(const TextRow& row) const;

  ReadContext& context_;
  const StampPlan& stamps_;
  RowStream rows_;
  std::size_t window_;
  std::optional<TimeUnit> unit_;
  bool told_ = true;            ///< the unit needs no further check
  std::vector<TextRow> first_;  ///< the rows that told the unit
  std::size_t first_given_ = 0;
};

}  // namespace vispline
