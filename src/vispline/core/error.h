/// Errors and warnings: a stable code, one sentence with the number that proves it, the place, the effect, the next
/// step. The library prints nothing; a command prints what it is handed. docs/conventions.md, Errors.
#pragma once

#include <cstdint>
#include <exception>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vispline {

/// What the process ends with when nobody handles the error.
enum class ExitCode : int {
  kDone = 0,
  kUsage = 2,      ///< wrong flag or configuration value
  kInput = 3,      ///< input cannot be read or is malformed
  kUnfit = 4,      ///< input is readable but unfit for this analysis
  kUntrusted = 5,  ///< a solver gave no trustworthy result
  kOutput = 6,     ///< output could not be written
  kLimit = 7,      ///< a resource limit was hit
};

struct Diagnostic {
  std::string code;     ///< "E-TIME-RESET", "W-GAP"; an E stops the run, a W does not
  std::string message;  ///< one sentence, with the number that proves it
  std::string where;    ///< file:line, or file and column; may be empty
  std::string effect;   ///< what was or was not done
  std::string next;     ///< the flag or step that settles it
};

/// `warning[W-GAP]: message` with the lines where, effect and next below it, each only if it is not empty.
std::string to_text(const Diagnostic& diagnostic);

/// Thrown for bad input and for a broken public precondition; caught in cli/main.cc and at the Python border.
class Error : public std::exception {
 public:
  Error(ExitCode exit_code, Diagnostic diagnostic);
  const char* what() const noexcept override { return text_.c_str(); }
  ExitCode exit_code() const { return exit_code_; }
  const Diagnostic& diagnostic() const { return diagnostic_; }

 private:
  ExitCode exit_code_;
  Diagnostic diagnostic_;
  std::string text_;
};

/// Throws Error(kUsage, "E-ARGUMENT") unless the caller kept its side of a public contract.
void require(bool condition, std::string_view expected);

/// The warnings of one run: every occurrence is counted, at most three of each code are kept.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic);
  void merge(const Diagnostics& other);
  const std::vector<Diagnostic>& examples() const { return examples_; }
  const std::map<std::string, std::int64_t>& counts() const { return counts_; }
  bool empty() const { return examples_.empty(); }

 private:
  std::vector<Diagnostic> examples_;
  std::map<std::string, std::int64_t> counts_;
};

/// How many records were read, and why those that are missing are missing: read = kept + dropped.
struct ReadCounts {
  std::int64_t read = 0;
  std::int64_t kept = 0;
  std::map<std::string, std::int64_t> dropped;  ///< by diagnostic code
  std::int64_t dropped_total() const;
};

/// Text that a stranger wrote, safe to print: control bytes as \xNN, cut at 200 bytes, in single quotes.
std::string quoted(std::string_view untrusted);

}  // namespace vispline
