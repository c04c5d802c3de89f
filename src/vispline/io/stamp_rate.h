/// Warnings about the rhythm of the kept stamps: gaps, rounding, jitter, a changing rate. Nothing is dropped.
#pragma once

#include "vispline/io/stamps.h"

namespace vispline {

/// W-GAP for each step above max(10 median steps, 0.1 s); W-TIME-PRECISION if all steps are multiples of one coarse
/// step; W-RATE for jitter above 20 %, more than 0.1 % lost samples, or halves whose rates differ by more than 2 %.
void check_rate(ReadContext& context, const StampedRows& rows);

}  // namespace vispline
