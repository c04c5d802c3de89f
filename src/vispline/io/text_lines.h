/// The lines of a text file one after another, in a buffer of bounded size.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "vispline/files/input_file.h"
#include "vispline/io/read_context.h"

namespace vispline {

/// Called now and then with the bytes taken from the disk, of all; what it throws ends the reading.
using ReadProgress = std::function<void(std::uint64_t done, std::uint64_t total)>;

/// The progress of pass `pass`, from 0, of a file that is read `passes` times.
ReadProgress part_of(const ReadProgress& progress, std::uint64_t pass, std::uint64_t passes);

struct TextLine {
  std::string_view text;  ///< without its line end; valid until the next call
  std::int64_t number;    ///< from 1
  bool has_end;           ///< false: the file ends here, the line may be cut
};

class TextLines {
 public:
  /// Opens the file of `context`. Line ends become LF and a byte order mark is left out. `block_bytes` are read at a
  /// time; the buffer holds the head, or a line and a block. Throws as InputFile does.
  TextLines(const ReadContext& context, std::size_t block_bytes = std::size_t{1} << 20, ReadProgress progress = {});

  /// The beginning of the text: whole lines with at least `rows` rows (neither blank nor comment), or the whole text if
  /// it has fewer. Throws E-LIMIT if that does not fit into limits::kHeadBytes. Before start_at and next only.
  std::string_view head(std::size_t rows);

  /// The next line is the one at offset `pos` of the head, whose number is `line`.
  void start_at(std::size_t pos, std::int64_t line);

  /// False at the end of the file. Throws E-LIMIT for a line above limits::kLineBytes.
  bool next(TextLine& line);

  /// The most that the buffer has held, in bytes.
  std::size_t largest_buffer() const { return buffer_.size(); }

 private:
  void fill();
  void normalise(std::size_t from);
  std::string_view text() const { return {buffer_.data() + begin_, end_ - begin_}; }

  const ReadContext& context_;
  InputFile file_;
  std::size_t block_bytes_;
  ReadProgress progress_;
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< the part of the buffer that is still to be handed out
  std::int64_t number_ = 1;
  bool ended_ = false;     ///< the file has no more bytes
  bool after_cr_ = false;  ///< the last byte read was a CR, handed out as LF
};

}  // namespace vispline
