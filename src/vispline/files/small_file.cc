#include "vispline/files/small_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "vispline/core/error.h"
#include "vispline/files/content_type.h"

namespace vispline {
namespace {

[[noreturn]] void fail_open(const std::string& path, const std::string& reason) {
  throw Error(ExitCode::kInput, {.code = "E-OPEN",
                                 .message = "cannot open " + vispline::quoted(path) + ": " + reason,
                                 .where = "",
                                 .effect = "nothing read",
                                 .next = "name an existing regular file that you may read"});
}

/// At most `most` bytes; closes the file.
std::string read_and_close(int fd, const std::string& path, std::size_t most) {
  std::string bytes(most, '\0');
  std::size_t done = 0;
  ssize_t got = 1;
  while (done < most && got > 0) {
    got = ::read(fd, bytes.data() + done, most - done);
    if (got > 0) done += static_cast<std::size_t>(got);
    if (got < 0 && errno == EINTR) got = 1;
  }
  const int code = errno;
  ::close(fd);
  if (got < 0) fail_open(path, std::generic_category().message(code));
  bytes.resize(done);
  return bytes;
}

std::string read_regular(const std::string& path, std::size_t most) {
  if (path.find('\0') != std::string::npos) fail_open(path, "the name holds a NUL byte");
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) fail_open(path, std::generic_category().message(errno));
  struct stat info {};
  if (::fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
    ::close(fd);
    fail_open(path, S_ISDIR(info.st_mode) ? "it is a folder" : "it is not a regular file");
  }
  return read_and_close(fd, path, most);
}

}  // namespace

std::string read_small_text_file(const std::string& path, std::size_t cap) {
  std::string bytes = read_regular(path, cap + 1);
  if (bytes.size() > cap) {
    throw Error(ExitCode::kLimit, {.code = "E-LIMIT",
                                   .message = "more than " + std::to_string(cap) + " bytes in a parameter file",
                                   .where = path,
                                   .effect = "nothing read",
                                   .next = ""});
  }
  const auto found = not_text(bytes);
  if (!found || *found == "YAML" || *found == "JSON") return bytes;
  throw Error(ExitCode::kInput, {.code = "E-FORMAT",
                                 .message = "expected a parameter file in YAML or JSON, found " + std::string(*found),
                                 .where = path,
                                 .effect = "nothing read",
                                 .next = ""});
}

}  // namespace vispline
