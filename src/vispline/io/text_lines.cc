#include "vispline/io/text_lines.h"

#include <cstring>
#include <utility>

#include "vispline/files/limits.h"
#include "vispline/io/text_cells.h"

namespace vispline {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

[[noreturn]] void fail_long_line(const ReadContext& context, std::int64_t number) {
  context.fail(ExitCode::kLimit, "E-LIMIT", "a line is longer than " + std::to_string(limits::kLineBytes) + " bytes",
               context.where_line(number), "check that this is a table with one row a line");
}

/// Offset behind the line that holds row number `rows`; 0 if the text has fewer whole rows.
std::size_t end_of_rows(std::string_view text, std::size_t rows) {
  std::size_t pos = 0;
  while (rows > 0) {
    const std::size_t end = text.find('\n', pos);
    if (end == std::string_view::npos) return 0;
    rows -= !is_comment(text.substr(pos, end - pos));
    pos = end + 1;
  }
  return pos;
}

}  // namespace

ReadProgress part_of(const ReadProgress& progress, std::uint64_t pass, std::uint64_t passes) {
  if (!progress) return {};
  return [=](std::uint64_t done, std::uint64_t total) { progress((total * pass + done) / passes, total); };
}

TextLines::TextLines(const ReadContext& context, std::size_t block_bytes, ReadProgress progress)
    : context_(context),
      file_(context.path(), block_bytes),
      block_bytes_(block_bytes),
      progress_(std::move(progress)) {}

/// Makes room by moving what is left to the front, and reads one block behind it.
void TextLines::fill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= std::exchange(begin_, 0);
  if (buffer_.size() < end_ + block_bytes_) buffer_.resize(end_ + block_bytes_);
  const std::size_t got = file_.read(buffer_.data() + end_, block_bytes_);
  ended_ = got == 0;
  const std::size_t from = end_;
  end_ += got;
  normalise(from);
  if (progress_) progress_(file_.bytes_done(), file_.bytes_total());
}

/// CRLF and lone CR become LF, in place, also where a block ends between CR and LF.
void TextLines::normalise(std::size_t from) {
  char* const data = buffer_.data();
  if (!after_cr_ && std::memchr(data + from, '\r', end_ - from) == nullptr) return;
  std::size_t out = from;
  for (std::size_t i = from; i < end_; ++i) {
    const bool second_half = after_cr_ && data[i] == '\n';
    after_cr_ = data[i] == '\r';
    if (!second_half) data[out++] = after_cr_ ? '\n' : data[i];
  }
  end_ = out;
}

std::string_view TextLines::head(std::size_t rows) {
  std::size_t size = 0;
  while (!ended_ && (size = end_of_rows(text(), rows)) == 0) {
    if (end_ > limits::kHeadBytes) {
      context_.fail(ExitCode::kLimit, "E-LIMIT",
                    "the first " + std::to_string(limits::kHeadBytes) + " bytes hold no rows of numbers",
                    context_.path(), "check that this is a table with one row a line");
    }
    fill();
  }
  if (text().starts_with(kByteOrderMark)) {
    begin_ += kByteOrderMark.size();
    size -= size > 0 ? kByteOrderMark.size() : 0;
  }
  return ended_ ? text() : text().substr(0, size);
}

void TextLines::start_at(std::size_t pos, std::int64_t line) {
  begin_ += pos;
  number_ = line;
}

bool TextLines::next(TextLine& line) {
  std::size_t size = text().find('\n');
  while (size == std::string_view::npos && !ended_) {
    const std::size_t seen = text().size();
    if (seen > limits::kLineBytes) fail_long_line(context_, number_);
    fill();
    size = text().find('\n', seen);
  }
  const bool has_end = size != std::string_view::npos;
  if (!has_end) size = text().size();
  if (!has_end && size == 0) return false;
  if (size > limits::kLineBytes) fail_long_line(context_, number_);
  line = {text().substr(0, size), number_++, has_end};
  begin_ += size + (has_end ? 1 : 0);
  return true;
}

}  // namespace vispline
