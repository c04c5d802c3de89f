#include "vispline/files/output_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "vispline/core/error.h"

namespace vispline {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
constexpr int kNameAttempts = 100;

std::string errno_text() { return std::generic_category().message(errno); }

/// 16 hexadecimal digits nobody can foresee; they appear in no result.
std::string random_word() {
  std::uint64_t bits = 0;
  if (::getrandom(&bits, sizeof bits, 0) != static_cast<ssize_t>(sizeof bits))
    bits = static_cast<std::uint64_t>(::getpid());
  std::array<char, 16> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), bits, 16);
  return {text.data(), end};
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Without umask(2), which would change it for other threads for a moment.
mode_t current_umask() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("Umask:")) continue;
    const std::size_t digit = line.find_first_of("01234567");
    unsigned mask = 022;
    if (digit != std::string::npos) std::from_chars(line.data() + digit, line.data() + line.size(), mask, 8);
    return static_cast<mode_t>(mask);
  }
  return 022;
}

bool sync_folder(const std::string& path) {
  const int fd = ::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool good = ::fsync(fd) == 0 || errno == EINVAL;
  return ::close(fd) == 0 && good;
}

}  // namespace

OutputFile::OutputFile(std::string path, OutputOptions options)
    : path_(std::move(path)), options_(options), compressor_(compressor_for(path_)) {
  if (path_.empty() || path_.back() == '/' || path_.find('\0') != std::string::npos)
    fail("the name is not that of a file");
  std::error_code error;
  std::filesystem::create_directories(folder_of(path_), error);
  if (error) fail("cannot make the folder: " + error.message());
  struct stat info {};
  const bool exists = ::lstat(path_.c_str(), &info) == 0;
  if (exists && !S_ISREG(info.st_mode)) fail("it exists and is not a regular file");
  if (exists && !options_.force) fail("it exists");
  open_partial();
}

OutputFile::~OutputFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  ::unlink(partial_.c_str());
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      partial_(std::move(other.partial_)),
      options_(other.options_),
      compressor_(std::move(other.compressor_)),
      buffer_(std::move(other.buffer_)),
      written_(other.written_),
      fd_(std::exchange(other.fd_, -1)) {}

void OutputFile::open_partial() {
  for (int attempt = 0; attempt < kNameAttempts && fd_ < 0; ++attempt) {
    partial_ = path_ + "." + random_word() + ".partial";
    fd_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (fd_ < 0 && errno != EEXIST) break;
  }
  if (fd_ < 0) fail(errno_text());
}

void OutputFile::write(std::string_view bytes) {
  buffer_.append(bytes);
  if (buffer_.size() >= kBufferBytes) flush(false);
}

void OutputFile::flush(bool last) {
  if (compressor_ == nullptr) {
    write_raw(buffer_);
  } else {
    std::string packed;
    compressor_->compress(buffer_, last, packed);
    write_raw(packed);
  }
  buffer_.clear();
}

void OutputFile::write_raw(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(fd_, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail(done < 0 ? errno_text() : "nothing could be written");
    written_ += static_cast<std::uint64_t>(done);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::patch(std::uint64_t offset, std::string_view bytes) {
  require(compressor_ == nullptr, "an output file that is not compressed");
  flush(false);
  require(offset <= written_ && bytes.size() <= written_ - offset, "bytes that were written before");
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail(done < 0 ? errno_text() : "nothing could be written");
    offset += static_cast<std::uint64_t>(done);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::publish() {
  require(fd_ >= 0, "an output file that is not published yet");
  flush(true);
  struct stat info {};
  if (::fstat(fd_, &info) != 0) fail(errno_text());
  if (static_cast<std::uint64_t>(info.st_size) != written_) fail("the size on disk is not what was written");
  if (::fchmod(fd_, 0666 & ~current_umask()) != 0) fail(errno_text());
  if (options_.sync && ::fsync(fd_) != 0) fail(errno_text());
  rename_to_final();
  if (::close(std::exchange(fd_, -1)) != 0) fail(errno_text());
  if (options_.sync && !sync_folder(path_)) fail("the folder cannot be flushed to the disk");
}

/// Never replaces a file that appeared meanwhile, unless force is given.
void OutputFile::rename_to_final() {
  if (options_.force) {
    if (::rename(partial_.c_str(), path_.c_str()) != 0) fail(errno_text());
    return;
  }
  if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno == EEXIST) fail("it exists");
  if (errno != EINVAL && errno != ENOSYS) fail(errno_text());
  if (::link(partial_.c_str(), path_.c_str()) != 0) fail(errno == EEXIST ? "it exists" : errno_text());
  ::unlink(partial_.c_str());
}

void OutputFile::fail(const std::string& what) const {
  throw Error(ExitCode::kOutput,
              {.code = "E-OUTPUT",
               .message = "cannot write " + vispline::quoted(path_) + ": " + what,
               .where = "",
               .effect = "no result written; what was there before is untouched",
               .next = what == "it exists" ? "pass --force to replace it, or name another file"
                                           : "name a file in a folder that you may write, on a disk with room"});
}

void write_file(const std::string& path, std::string_view bytes, OutputOptions options) {
  OutputFile file(path, options);
  file.write(bytes);
  file.publish();
}

void probe_output(const std::string& path, std::uint64_t bytes, OutputOptions options) {
  const OutputFile file(path, options);
  struct statvfs disk {};
  if (::statvfs(folder_of(path).c_str(), &disk) != 0) return;
  const std::uint64_t room = static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
  if (room >= bytes) return;
  throw Error(ExitCode::kOutput, {.code = "E-OUTPUT",
                                  .message = "cannot write " + vispline::quoted(path) + ": " + std::to_string(bytes) +
                                             " bytes are needed, the disk has room for " + std::to_string(room),
                                  .where = "",
                                  .effect = "nothing done",
                                  .next = "make room, or name a file on another disk"});
}

}  // namespace vispline
