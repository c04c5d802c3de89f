#include "console.h"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <string_view>

namespace vispline::cli {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

volatile std::sig_atomic_t files_open = 0;
constexpr unsigned kGrace_s = 1;

extern "C" void on_signal(int signal) {
  if (caught_signal != 0) _exit(128 + signal);
  caught_signal = signal;
  alarm(kGrace_s);
}

extern "C" void on_alarm(int) {
  if (files_open != 0) {
    alarm(kGrace_s);
    return;
  }
  constexpr std::string_view kText = "error[E-INTERRUPTED]: stopped by a signal\n  effect: nothing written\n";
  if (write(STDERR_FILENO, kText.data(), kText.size()) < 0) _exit(1);
  _exit(128 + caught_signal);
}

std::int64_t now_ms() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

void print(const Diagnostics& diagnostics) {
  for (const Diagnostic& example : diagnostics.examples()) std::cerr << to_text(example) << '\n';
  for (const auto& [code, count] : diagnostics.counts()) {
    std::int64_t shown = 0;
    for (const Diagnostic& example : diagnostics.examples()) shown += example.code == code;
    if (count > shown) std::cerr << "warning[" << code << "]: and " << count - shown << " more\n";
  }
}

[[noreturn]] void refuse(Diagnostic warning) {
  warning.code.replace(0, 1, "E");
  warning.effect = "nothing written, because of --strict";
  throw Error(ExitCode::kUnfit, warning);
}

}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGALRM, on_alarm);
}

void poll_interrupt() {
  if (caught_signal != 0) throw Interrupted{caught_signal};
}

OutputGuard::OutputGuard() { files_open = files_open + 1; }

OutputGuard::~OutputGuard() { files_open = files_open - 1; }

Session::Session() { context.version = VISPLINE_VERSION; }

void Session::add_input(const std::string& role, const ReadCounts& counts, const Diagnostics& diagnostics) {
  context.inputs.push_back({role, counts});
  add(diagnostics);
}

void Session::add(const Diagnostics& diagnostics) { context.diagnostics.merge(diagnostics); }

void Session::add(Diagnostic diagnostic) { context.diagnostics.add(std::move(diagnostic)); }

void Session::finish(const Diagnostics& own) const {
  Diagnostics all = context.diagnostics;
  all.merge(own);
  if (strict && !all.empty()) refuse(all.examples().front());
  print(all);
  if (context.inputs.empty()) return;
  ReadCounts sum;
  for (const JsonInput& input : context.inputs) {
    sum.read += input.counts.read;
    sum.kept += input.counts.kept;
  }
  std::cerr << "samples: " << sum.read << " read, " << sum.kept << " kept, " << sum.read - sum.kept << " dropped\n";
}

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)), total_(total), last_ms_(now_ms()), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (terminal_ && shown_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::add(std::uint64_t done) {
  poll_interrupt();
  done_ += done;
  const std::int64_t now = now_ms();
  if (now - last_ms_ < (terminal_ ? 200 : 10'000)) return;
  last_ms_ = now;
  shown_ = true;
  const std::uint64_t percent = total_ == 0 ? 100 : 100 * done_ / total_;
  std::cerr << (terminal_ ? "\r" : "") << what_ << ": " << percent << "% " << done_ << '/' << total_
            << (terminal_ ? "" : "\n") << std::flush;
}

}  // namespace vispline::cli
