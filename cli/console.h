/// What a command says on stderr, and how it stops. Results go to stdout, everything else through here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vispline/core/error.h"
#include "vispline/results/json.h"

namespace vispline::cli {

/// Thrown at the next poll after SIGINT or SIGTERM; the process ends with 128 + signal.
struct Interrupted {
  int signal;
};

/// First signal: poll_interrupt() throws; the process ends within a second even if nothing polls. Second signal: it
/// ends at once.
void catch_interrupts();
void poll_interrupt();

/// While one lives, files may be unfinished: a first signal waits for poll_interrupt() or for the end of the writing.
class OutputGuard {
 public:
  OutputGuard();
  ~OutputGuard();
  OutputGuard(const OutputGuard&) = delete;
  OutputGuard& operator=(const OutputGuard&) = delete;
};

/// Flags that every verb has, and what its JSON document carries besides the result.
struct Session {
  bool json = false;
  bool strict = false;
  bool force = false;
  JsonContext context;

  Session();
  /// Counts and warnings of one input, under the name of its role.
  void add_input(const std::string& role, const ReadCounts& counts, const Diagnostics& diagnostics);
  void add(const Diagnostics& diagnostics);
  void add(Diagnostic diagnostic);
  /// Prints warnings and, if anything was read, the line `samples: N read, N kept, N dropped`. Throws the first warning
  /// as an error under --strict.
  void finish(const Diagnostics& own = {}) const;
};

/// Progress on stderr: a bar on a terminal, a line every ten seconds elsewhere.
class Progress {
 public:
  Progress(std::string what, std::uint64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Also polls for interrupts.
  void add(std::uint64_t done);

 private:
  std::string what_;
  std::uint64_t total_, done_ = 0;
  std::int64_t last_ms_;
  bool terminal_, shown_ = false;
};

}  // namespace vispline::cli
