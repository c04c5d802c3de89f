#include "vispline/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

#include "vispline/core/error.h"
#include "vispline/files/content_type.h"
#include "vispline/files/decompress.h"

namespace vispline {
namespace {

[[noreturn]] void fail_open(const std::string& path, const std::string& reason) {
  throw Error(ExitCode::kInput, {.code = "E-OPEN",
                                 .message = "cannot open " + vispline::quoted(path) + ": " + reason,
                                 .where = "",
                                 .effect = "nothing read",
                                 .next = "name an existing regular file that you may read"});
}

std::string errno_text() { return std::generic_category().message(errno); }

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "it is a folder";
  if (S_ISFIFO(mode)) return "it is a FIFO";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "it is a device";
  if (S_ISSOCK(mode)) return "it is a socket";
  return "it is not a regular file";
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

std::string reason_absent(const std::string& path) {
  const int code = errno;
  struct stat link {};
  if (code == ENOENT && ::lstat(path.c_str(), &link) == 0 && S_ISLNK(link.st_mode)) return "the link points nowhere";
  errno = code;
  return errno_text();
}

/// Stops early once `enough` bytes are there; tolerates a file that grows or shrinks meanwhile.
std::string read_all(int fd, std::size_t size, const std::string& path) {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(fd, bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_open(path, errno_text());
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

std::string read_regular(const std::string& path, std::uint64_t enough) {
  struct stat before {};
  if (::stat(path.c_str(), &before) != 0) fail_open(path, reason_absent(path));
  if (!S_ISREG(before.st_mode)) fail_open(path, kind_of(before.st_mode));
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0) fail_open(path, errno_text());
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) fail_open(path, errno_text());
  if (!S_ISREG(info.st_mode)) fail_open(path, kind_of(info.st_mode));
  const auto size = static_cast<std::uint64_t>(info.st_size);
  std::string head = read_all(file.get(), static_cast<std::size_t>(std::min<std::uint64_t>(size, 4096)), path);
  const bool whole = compression_of(head) != Compression::kNone;  // a stream is decoded from memory
  const std::uint64_t wanted = whole ? size : std::min(size, enough);
  if (::lseek(file.get(), 0, SEEK_SET) < 0) fail_open(path, errno_text());
  return read_all(file.get(), static_cast<std::size_t>(wanted), path);
}

}  // namespace

std::string read_text_file(const std::string& path, std::uint64_t enough) {
  if (path.find('\0') != std::string::npos) fail_open(path, "the name holds a NUL byte");
  std::string bytes = read_regular(path, enough);
  const Compression compression = compression_of(bytes);
  if (compression != Compression::kNone) {
    bytes = decompress(path, bytes, compression, expansion_cap(bytes.size()), enough);
  }
  if (const auto found = not_text(bytes)) {
    throw Error(ExitCode::kInput, {.code = "E-FORMAT",
                                   .message = "expected a text table, found " + std::string(*found),
                                   .where = path,
                                   .effect = "nothing read",
                                   .next = "convert it to CSV or TUM text in UTF-8 first"});
  }
  return bytes;
}

}  // namespace vispline
