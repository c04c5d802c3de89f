/// Warnings about the rhythm of the kept stamps: gaps, rounding, jitter, a changing rate. Nothing is dropped.
#pragma once

#include <cstdint>
#include <vector>

#include "vispline/io/even_sample.h"
#include "vispline/io/read_context.h"

namespace vispline {

/// Median of steps in ns; 0 of none. At most 52 days, so that multiples of it fit.
std::int64_t median_of_steps(std::vector<std::int64_t> steps);

/// Sees each kept stamp once and remembers a sample of the steps.
class RateCheck {
 public:
  explicit RateCheck(ReadContext& context) : context_(context) {}

  /// Stamps strictly increase; `where` is their place in the file.
  void add(std::int64_t ns, std::int64_t where) {
    if (rows_++ > 0) add_step(ns, where);
    last_ = ns;
  }

  /// After the last stamp. One W-GAP for the steps above max(10 median steps, 0.1 s); W-TIME-PRECISION if all steps are
  /// multiples of one coarse step; W-RATE for jitter above 20 %, more than 0.1 % lost samples, or halves whose rates
  /// differ by more than 2 %. Nothing for fewer than ten stamps.
  void judge();

  /// Median step between neighbours, ns; 0 for fewer than two stamps.
  std::int64_t median_step() const;

 private:
  struct Gap {
    std::int64_t after, step, where;
  };

  void add_step(std::int64_t ns, std::int64_t where);
  void judge_gaps();
  void tell_gaps();

  ReadContext& context_;
  std::int64_t rows_ = 0;
  std::int64_t last_ = 0;
  EvenSample<std::int64_t> steps_;
  std::vector<Gap> long_steps_;  ///< that may turn out to be gaps
  std::int64_t gaps_ = 0, in_gaps_ = 0;
  Gap longest_{0, 0, 0};
};

}  // namespace vispline
