#include "vispline/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

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

constexpr std::size_t kHeadBytes = 4096;  ///< looked at to tell text from anything else

std::string reason_absent(const std::string& path) {
  const int code = errno;
  struct stat link {};
  if (code == ENOENT && ::lstat(path.c_str(), &link) == 0 && S_ISLNK(link.st_mode)) return "the link points nowhere";
  errno = code;
  return errno_text();
}

int open_regular(const std::string& path) {
  if (path.find('\0') != std::string::npos) fail_open(path, "the name holds a NUL byte");
  struct stat before {};
  if (::stat(path.c_str(), &before) != 0) fail_open(path, reason_absent(path));
  if (!S_ISREG(before.st_mode)) fail_open(path, kind_of(before.st_mode));
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) fail_open(path, errno_text());
  return fd;
}

/// A regular file as it was when it was opened: it may shrink, but what is appended is not seen.
class RawFile {
 public:
  explicit RawFile(const std::string& path) : path_(path), fd_(open_regular(path)) {}
  ~RawFile() { ::close(fd_); }
  RawFile(const RawFile&) = delete;
  RawFile& operator=(const RawFile&) = delete;

  void measure() {
    struct stat info {};
    if (::fstat(fd_, &info) != 0) fail_open(path_, errno_text());
    if (!S_ISREG(info.st_mode)) fail_open(path_, kind_of(info.st_mode));
    total = static_cast<std::uint64_t>(info.st_size);
  }

  std::size_t read(char* out, std::size_t room) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(room, total - done));
    ssize_t got = 0;
    do {
      got = ::read(fd_, out, wanted);
    } while (got < 0 && errno == EINTR);
    if (got < 0) fail_open(path_, errno_text());
    done += static_cast<std::uint64_t>(got);
    return static_cast<std::size_t>(got);
  }

  void rewind() {
    if (::lseek(fd_, 0, SEEK_SET) < 0) fail_open(path_, errno_text());
    done = 0;
  }

  std::uint64_t done = 0;
  std::uint64_t total = 0;

 private:
  std::string path_;
  int fd_;
};

/// Up to `size` bytes, fewer only at the end.
template <class Source>
std::string read_up_to(Source&& source, std::size_t size) {
  std::string bytes(size, '\0');
  std::size_t filled = 0;
  while (filled < size) {
    const std::size_t got = source(bytes.data() + filled, size - filled);
    if (got == 0) break;
    filled += got;
  }
  bytes.resize(filled);
  return bytes;
}

void check_text(const std::string& path, std::string_view head) {
  const auto found = not_text(head);
  if (!found) return;
  throw Error(ExitCode::kInput, {.code = "E-FORMAT",
                                 .message = "expected a text table, found " + std::string(*found),
                                 .where = path,
                                 .effect = "nothing read",
                                 .next = "convert it to CSV or TUM text in UTF-8 first"});
}

}  // namespace

struct InputFile::State {
  explicit State(const std::string& path) : file(path) { file.measure(); }

  std::size_t read_text(char* out, std::size_t room) { return stream ? stream->read(out, room) : file.read(out, room); }

  RawFile file;
  std::optional<Decompressor> stream;
  std::string head;  ///< text that was looked at and is still to be handed out
  std::size_t head_given = 0;
};

InputFile::InputFile(const std::string& path, std::size_t block_bytes) : state_(std::make_unique<State>(path)) {
  State& s = *state_;
  const auto raw = [&s](char* out, std::size_t room) { return s.file.read(out, room); };
  const Compression compression = compression_of(read_up_to(raw, kHeadBytes));
  s.file.rewind();
  if (compression != Compression::kNone) {
    s.stream.emplace(path, compression, raw, expansion_cap(s.file.total), block_bytes);
  }
  s.head = read_up_to([&s](char* out, std::size_t room) { return s.read_text(out, room); }, kHeadBytes);
  check_text(path, s.head);
}

InputFile::~InputFile() = default;
InputFile::InputFile(InputFile&&) noexcept = default;
InputFile& InputFile::operator=(InputFile&&) noexcept = default;

std::size_t InputFile::read(char* out, std::size_t room) {
  State& s = *state_;
  if (s.head_given == s.head.size()) return s.read_text(out, room);
  const std::size_t take = s.head.copy(out, room, s.head_given);
  s.head_given += take;
  return take;
}

std::uint64_t InputFile::bytes_done() const { return state_->file.done; }
std::uint64_t InputFile::bytes_total() const { return state_->file.total; }

std::string read_text_file(const std::string& path, std::uint64_t enough) {
  InputFile file(path);
  std::string text, block(std::size_t{1} << 16, '\0');
  while (text.size() < enough) {
    const std::size_t got = file.read(block.data(), block.size());
    if (got == 0) break;
    text.append(block, 0, got);
  }
  return text;
}

}  // namespace vispline
