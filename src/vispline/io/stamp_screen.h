/// Checks of the stamps of a signal, the same for every signal and every kind of file: which rows are kept, in which
/// order. Works in a window, so that a recording of any length takes constant memory. docs/formats.md, Diagnostics.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "vispline/io/even_sample.h"
#include "vispline/io/read_context.h"
#include "vispline/io/stamp_rate.h"
#include "vispline/io/text_row.h"

namespace vispline {

/// One row of a recording.
struct SensorRow {
  std::int64_t ns = kNoStamp;  ///< kNoStamp: it is no time of 64 bits
  RowValues values{};          ///< those that the signal has not are equal in all rows, or nan
  std::int64_t where = 0;      ///< the place in the file, for messages: a line number
  bool scientific = false;     ///< the stamp was written with an exponent
};

/// Rows that may arrive late at most; a day at 200 Hz has 17 million.
inline constexpr std::size_t kWindowRows = 4096;

class StampScreen {
 public:
  /// Gets the kept rows, stamps strictly increasing over all calls.
  using Sink = std::function<void(std::span<const SensorRow>)>;

  /// `window` (8 or more): a row that comes later than so many others cannot be put in its place. At most four windows
  /// of rows are held.
  StampScreen(ReadContext& context, Sink sink, std::size_t window = kWindowRows);

  /// The next row as the file has it. The caller has counted it in context.counts.read. Drops stamps out of range
  /// (W-TIME-RANGE), isolated outliers (W-TIME-OUTLIER) and duplicates (W-DUPLICATE); sorts late rows.
  void push(const SensorRow& row);

  /// There are no more rows: the last ones go to the sink.
  void flush();

  /// After flush. Throws E-TIME-RANGE, E-TIME-RESET, E-ORDER, E-TIME-PRECISION or E-DUPLICATE if the losses are too
  /// many. `unit_ns`: nanoseconds that one unit of the file's stamps stands for. Warns W-ORDER.
  void judge(double unit_ns);

  /// Rows with stamps in range, and how many distinct stamps were kept.
  std::int64_t rows_in_range() const { return in_range_; }
  std::int64_t rows_kept() const { return kept_; }
  /// Median of the steps between stamps that differ, in either direction, as the rows came; 0: there are none.
  std::int64_t median_step() const { return median_of_steps(steps_.values()); }
  /// The most rows that were held at a time.
  std::size_t largest_window() const { return largest_; }

 private:
  void add_step(std::int64_t ns);
  std::int64_t recent_median_step();
  void drop_outliers(bool last);
  bool is_off(std::size_t i, std::int64_t step, bool last) const;
  std::vector<std::size_t> find_off(std::size_t stop, bool last);
  void arrive(std::span<const SensorRow> rows);
  void arrive_alone(const SensorRow& row);
  void extend_run(std::int64_t ns);
  void emit(std::size_t count);
  void drop_duplicates(std::span<const SensorRow> rows);
  void judge_range() const;
  void judge_reset(double unit_ns) const;
  void judge_order();
  void judge_duplicates() const;

  ReadContext& context_;
  Sink sink_;
  std::size_t window_;
  std::size_t largest_ = 0;

  std::vector<SensorRow> raw_;  ///< in range, as they came; the first done_ are only there as neighbours
  std::size_t done_ = 0;
  bool at_start_ = true;
  bool raw_in_order_ = true;  ///< strictly
  std::int64_t last_raw_ = kNoStamp;
  EvenSample<std::int64_t> steps_;
  std::uint64_t steps_at_median_ = 0;
  std::int64_t median_step_ = 0;

  std::vector<SensorRow> waiting_;  ///< for rows that come late
  bool sorted_ = true;
  /// Patience sorting: tails_[k] ends a run in order of in_order_ + k + 1 rows. Those that left the window are final.
  std::vector<std::int64_t> tails_;
  std::int64_t in_order_ = 0;
  SensorRow group_;  ///< the first row of the stamp that was emitted last

  std::int64_t in_range_ = 0, out_of_range_ = 0, arrived_ = 0, kept_ = 0;
  std::int64_t last_arrived_ = 0;
  struct Back {
    std::int64_t count = 0;
    std::int64_t index = 0, where = 0, before = 0, after = 0;  ///< of the first one
    void add(std::int64_t at_index, const SensorRow& row, std::int64_t before_ns);
  } backs_, resets_;
  std::int64_t too_late_ = 0, other_values_ = 0;
  SensorRow other_example_;
};

}  // namespace vispline
