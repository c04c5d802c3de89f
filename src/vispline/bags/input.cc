#include "vispline/bags/input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "vispline/core/error.h"

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

std::string reason_absent(const std::string& path) {
  const int code = errno;
  struct stat link {};
  if (code == ENOENT && ::lstat(path.c_str(), &link) == 0 && S_ISLNK(link.st_mode)) return "the link points nowhere";
  return std::generic_category().message(code);
}

}  // namespace

Input::Input(int fd, std::uint64_t size, std::string memory, std::string name)
    : fd_(fd), size_(size), memory_(std::move(memory)), name_(std::move(name)) {}

Input::Input(Input&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      size_(other.size_),
      memory_(std::move(other.memory_)),
      name_(std::move(other.name_)) {}

Input::~Input() {
  if (fd_ >= 0) ::close(fd_);
}

Input Input::open(const std::string& path) {
  if (path.find('\0') != std::string::npos) fail_open(path, "the name holds a NUL byte");
  struct stat before {};
  if (::stat(path.c_str(), &before) != 0) fail_open(path, reason_absent(path));
  if (!S_ISREG(before.st_mode)) fail_open(path, kind_of(before.st_mode));
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (fd < 0) fail_open(path, errno_text());
  return from_descriptor(fd, path);
}

Input Input::from_descriptor(int fd, std::string name) {
  struct stat info {};
  Input input(fd, 0, {}, std::move(name));
  if (::fstat(fd, &info) != 0) fail_open(input.name_, errno_text());
  if (!S_ISREG(info.st_mode)) fail_open(input.name_, kind_of(info.st_mode));
  input.size_ = static_cast<std::uint64_t>(info.st_size);
  return input;
}

Input Input::from_memory(std::string bytes, std::string name) {
  const std::uint64_t size = bytes.size();
  return Input(-1, size, std::move(bytes), std::move(name));
}

std::size_t Input::read_at(std::uint64_t offset, std::byte* to, std::size_t size) const {
  if (offset >= size_) return 0;
  size = static_cast<std::size_t>(std::min<std::uint64_t>(size, size_ - offset));
  if (fd_ < 0) {
    std::memcpy(to, memory_.data() + offset, size);
    return size;
  }
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::pread(fd_, to + done, size - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_open(name_, "reading failed at byte " + std::to_string(offset + done) + ": " + errno_text());
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::string Input::head(std::size_t size) const {
  std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(size, size_)), '\0');
  bytes.resize(read_at(0, reinterpret_cast<std::byte*>(bytes.data()), bytes.size()));
  return bytes;
}

Bytes Window::refill(std::uint64_t offset, std::size_t size) {
  if (input_ == nullptr) {  // all of the memory is at hand, so the view reaches beyond its end
    if (offset >= size_) return {};
    return {data_ + offset, static_cast<std::size_t>(size_ - offset)};
  }
  if (offset >= size_) return {};
  const std::uint64_t rest = size_ - offset;
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(rest, std::max(size, read_ahead_)));
  if (wanted > capacity_) {
    buffer_.reset();
    buffer_ = std::make_unique_for_overwrite<std::byte[]>(wanted);
    capacity_ = wanted;
  }
  data_ = buffer_.get();
  begin_ = offset;
  length_ = input_->read_at(offset, buffer_.get(), wanted);
  return {data_, static_cast<std::size_t>(std::min<std::uint64_t>(size, length_))};
}

}  // namespace vispline
