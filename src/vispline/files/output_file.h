/// Results on disk: a final name is whole or absent, and an old result survives a failed run. docs/formats.md, Outputs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "vispline/files/compressor.h"

namespace vispline {

struct OutputOptions {
  bool force = false;  ///< replace an existing regular file
  bool sync = true;    ///< wait for the disk; a set of many files may wait once, at its last
};

/// A file that is written beside its final name and renamed when it is whole. The folder is made if it is absent; a
/// name that ends in .gz or .xz is compressed. Every failure is Error(kOutput, "E-OUTPUT"), exit 6.
class OutputFile {
 public:
  explicit OutputFile(std::string path, OutputOptions options = {});
  /// Removes what was written unless publish() was called.
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;

  void write(std::string_view bytes);
  /// Replaces bytes that were written before, such as a header with counts. Not for compressed files.
  void patch(std::uint64_t offset, std::string_view bytes);
  /// Flushes to the disk, checks the size and gives the file its final name and mode (0666 less the umask).
  void publish();
  const std::string& path() const { return path_; }

 private:
  void open_partial();
  void flush(bool last);
  void write_raw(std::string_view bytes);
  void rename_to_final();
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::string partial_;
  OutputOptions options_;
  std::unique_ptr<Compressor> compressor_;
  std::string buffer_;
  std::uint64_t written_ = 0;
  int fd_ = -1;
};

/// Writes one whole file.
void write_file(const std::string& path, std::string_view bytes, OutputOptions options = {});

/// Proves before a long run that `path` can be written and that `bytes` fit on its disk; leaves nothing behind but the
/// folder. Throws E-OUTPUT.
void probe_output(const std::string& path, std::uint64_t bytes, OutputOptions options = {});

}  // namespace vispline
