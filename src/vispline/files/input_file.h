/// The bytes of a measurement file: opened read-only, regular files only, decompressed if the content says so.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace vispline {

/// A text file read from front to end in constant memory, gzip and xz taken off on the way.
class InputFile {
 public:
  /// Throws E-OPEN with the reason (exit 3) unless `path` is a regular file that can be read, E-FORMAT naming what was
  /// found if it is not text, E-CORRUPT for a damaged compressed stream and E-LIMIT (exit 7) for one that grows beyond
  /// the caps of limits.h. `block_bytes`: how much of a compressed file is taken at a time.
  explicit InputFile(const std::string& path, std::size_t block_bytes = std::size_t{1} << 16);
  ~InputFile();
  InputFile(InputFile&&) noexcept;
  InputFile& operator=(InputFile&&) noexcept;

  /// Up to `room` bytes of text; 0 at the end. Throws E-OPEN, E-CORRUPT and E-LIMIT. Bytes that are appended to the
  /// file after it was opened are not read.
  std::size_t read(char* out, std::size_t room);
  /// Bytes taken from the disk so far, of bytes_total(): how far the reading is.
  std::uint64_t bytes_done() const;
  std::uint64_t bytes_total() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All text of `path`, or about the first `enough` bytes of it. Throws as InputFile does.
std::string read_text_file(const std::string& path, std::uint64_t enough = UINT64_MAX);

}  // namespace vispline
