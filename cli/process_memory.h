/// How this process asks the system for memory.
#pragma once

namespace vispline::cli {

/// Matrices of many megabytes come and go with every iteration: keep their memory instead of having it taken back and
/// cleared each time, a tenth of the time of an estimation. Nothing where the C library is not glibc.
void keep_freed_memory();

}  // namespace vispline::cli
