/// Work split into fixed chunks that do not depend on the number of threads, so results are the same bytes for any.
#pragma once

#include <cstddef>
#include <functional>

namespace vispline {

/// Threads of this machine, at least 1.
std::size_t hardware_threads();

/// Calls work(chunk) once for every chunk in [0, chunks), on up to `threads` threads, in no particular order; returns
/// when all are done. Each chunk must write only its own output; reduce over chunks afterwards, in chunk order.
/// The first exception (by chunk number) is thrown again here, after the others have ended.
void parallel_for(std::size_t chunks, std::size_t threads, const std::function<void(std::size_t)>& work);

}  // namespace vispline
