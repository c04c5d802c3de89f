/// Runs the built program as a user would: arguments in, exit code, stdout, stderr and files out. No shell between.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "vispline/io/io_testing.h"

namespace vispline {

struct RunOptions {
  std::map<std::string, std::string> environment = {};  ///< beside that of the test
  std::string stdout_path = {};                         ///< a file or device instead of ProgramRun::out
  int signal = 0;                                       ///< sent once, as soon as signal_when() says so
  std::function<bool()> signal_when = {};
};

struct ProgramRun {
  int exit = -1;         ///< -1 if a signal killed it, which the program never lets happen
  std::string out, err;  ///< what it printed
  double stop_s = 0.0;   ///< from the signal to the end
  double peak_rss_mb = 0.0;

  std::string first_line() const { return err.substr(0, err.find('\n')); }
};

inline std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

inline std::vector<std::string> lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> found;
  for (std::string line; std::getline(stream, line);) found.push_back(line);
  return found;
}

/// A fresh folder in which the program runs; it is removed with all that is in it.
class Program {
 public:
  ProgramRun run(const std::vector<std::string>& arguments, const RunOptions& options = {}) const;
  /// One argument a word.
  ProgramRun run(const std::string& arguments, const RunOptions& options = {}) const {
    return run(words(arguments), options);
  }

  std::string path(const std::string& name) const { return work_.path(name); }
  std::string write(const std::string& name, const std::string& bytes) const { return work_.write(name, bytes); }
  std::string bytes(const std::string& name) const { return file_bytes(path(name)); }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  /// All files, relative and sorted.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(""))) {
      if (entry.is_regular_file()) names.push_back(std::filesystem::relative(entry.path(), path("")).string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  /// Bytes of the output that is being written; 0 between outputs, and when it goes while it is looked at.
  std::uintmax_t bytes_in_the_making() const {
    std::uintmax_t most = 0;
    std::error_code gone;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(""), gone)) {
      const std::uintmax_t size = entry.path().extension() == ".partial" ? entry.file_size(gone) : 0;
      if (!gone) most = std::max(most, size);
    }
    return most;
  }

 private:
  [[noreturn]] void become_program(const std::vector<std::string>& arguments, const RunOptions& options) const;

  ScratchFolder work_, output_;
};

namespace program_detail {

inline constexpr std::chrono::milliseconds kPoll(5);
inline constexpr std::chrono::seconds kPatience(300);

inline void redirect(int fd, const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ::dup2(file, fd) < 0) ::_exit(127);
}

inline void take_end(ProgramRun& run, int status, const rusage& usage) {
  run.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.peak_rss_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Sends the signal when it is due; kills what hangs.
inline void wait_for(pid_t child, const RunOptions& options, ProgramRun& run) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  auto signalled = Clock::time_point::max();
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, WNOHANG, &usage) == 0) {
    const auto now = Clock::now();
    if (signalled == Clock::time_point::max() && options.signal != 0 && options.signal_when()) {
      ::kill(child, options.signal);
      signalled = now;
    }
    if (now - begin > kPatience) ::kill(child, SIGKILL);
    std::this_thread::sleep_for(kPoll);
  }
  run.stop_s = std::chrono::duration<double>(Clock::now() - signalled).count();
  take_end(run, status, usage);
}

}  // namespace program_detail

inline void Program::become_program(const std::vector<std::string>& arguments, const RunOptions& options) const {
  std::string name = "vispline";
  std::vector<char*> argv{name.data()};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  for (const auto& [key, value] : options.environment) ::setenv(key.c_str(), value.c_str(), 1);
  program_detail::redirect(STDOUT_FILENO, options.stdout_path.empty() ? output_.path("out") : options.stdout_path);
  program_detail::redirect(STDERR_FILENO, output_.path("err"));
  if (::chdir(path("").c_str()) == 0) ::execv(VISPLINE_PROGRAM, argv.data());
  ::_exit(127);
}

inline ProgramRun Program::run(const std::vector<std::string>& arguments, const RunOptions& options) const {
  const pid_t child = ::fork();
  if (child == 0) become_program(arguments, options);
  ProgramRun run;
  program_detail::wait_for(child, options, run);
  run.out = options.stdout_path.empty() ? file_bytes(output_.path("out")) : "";
  run.err = file_bytes(output_.path("err"));
  return run;
}

}  // namespace vispline
