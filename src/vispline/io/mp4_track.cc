#include "vispline/io/mp4_track.h"

#include <algorithm>
#include <array>
#include <optional>

#include "vispline/core/error.h"
#include "vispline/io/gpmf.h"

namespace vispline::mp4 {
namespace {

using gpmf::key_of;

constexpr int kMaxBoxes = 100'000;
constexpr std::uint64_t kMaxTableBytes = std::uint64_t{8} << 20;  // a week of payloads of one second
constexpr std::uint64_t kMaxSettingsBytes = std::uint64_t{1} << 20;
constexpr int kMaxNesting = 8;

struct Box {
  std::uint32_t key = 0;
  std::uint64_t begin = 0, end = 0;  ///< of its content
};

std::uint64_t load_be(const std::string& bytes, std::size_t at, std::size_t width) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < width; ++i) value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// The boxes of one track that say where its samples are.
struct Track {
  std::uint32_t timescale = 0;
  bool is_telemetry = false;
  Box times, chunks, sizes, offsets;  ///< stts, stsc, stsz, stco or co64
  bool wide = false;                  ///< offsets of 8 bytes
};

struct Tables {
  std::string times, chunks, sizes, offsets;
};

class Walk {
 public:
  Walk(const Input& input, Telemetry& found) : input_(input), found_(found) {}

  void boxes(std::uint64_t begin, std::uint64_t end, int nesting) {
    while (begin < end) {
      const auto box = box_at(begin, end);
      if (!box) {
        found_.damaged = true;
        return;
      }
      visit(*box, nesting);
      begin = box->end;
    }
  }

 private:
  std::optional<Box> box_at(std::uint64_t at, std::uint64_t end) {
    if (++boxes_ > kMaxBoxes) fail("more than 100000 boxes");
    const std::string head = bytes(at, std::min<std::uint64_t>(16, end - at));
    if (head.size() < 8) return std::nullopt;
    std::uint64_t size = load_be(head, 0, 4), header = 8;
    if (size == 1 && head.size() == 16) {
      size = load_be(head, 8, 8);
      header = 16;
    } else if (size == 0) {
      size = end - at;
    }
    if (size < header) return std::nullopt;
    if (size > end - at) {
      if (end < input_.size() || head.size() < header) return std::nullopt;
      found_.damaged = true;  // the file is cut in this box: what is there of it counts
      size = end - at;
    }
    return Box{static_cast<std::uint32_t>(load_be(head, 4, 4)), at + header, at + size};
  }

  void visit(const Box& box, int nesting) {
    switch (box.key) {
      case key_of("trak"):
        track_ = {};
        descend(box, nesting);
        finish_track();
        break;
      case key_of("moov"):
      case key_of("mdia"):
      case key_of("minf"):
      case key_of("stbl"):
      case key_of("udta"):
        descend(box, nesting);
        break;
      case key_of("GPMF"):
        found_.settings = content(box, kMaxSettingsBytes);
        break;
      case key_of("mdhd"):
        read_timescale(content(box, 64));
        break;
      case key_of("stsd"):
        read_entry(content(box, 64));
        break;
      case key_of("stts"):
        track_.times = box;
        break;
      case key_of("stsc"):
        track_.chunks = box;
        break;
      case key_of("stsz"):
        track_.sizes = box;
        break;
      case key_of("co64"):
      case key_of("stco"):
        track_.offsets = box;
        track_.wide = box.key == key_of("co64");
        break;
      default:
        break;
    }
  }

  void descend(const Box& box, int nesting) {
    if (nesting < kMaxNesting) boxes(box.begin, box.end, nesting + 1);
  }

  std::string bytes(std::uint64_t at, std::uint64_t size) const {
    std::string out(static_cast<std::size_t>(size), '\0');
    out.resize(input_.read_at(at, reinterpret_cast<std::byte*>(out.data()), out.size()));
    return out;
  }

  /// The content of a box, up to `cap` bytes.
  std::string content(const Box& box, std::uint64_t cap) const {
    return bytes(box.begin, std::min(box.end - box.begin, cap));
  }

  std::string table(const Box& box) const {
    if (box.end - box.begin > kMaxTableBytes) fail("a table of telemetry of more than 8 MiB");
    return bytes(box.begin, box.end - box.begin);
  }

  void read_timescale(const std::string& mdhd) {
    const bool wide = !mdhd.empty() && mdhd[0] == 1;
    const std::size_t at = wide ? 20 : 12;
    if (mdhd.size() >= at + 4) track_.timescale = static_cast<std::uint32_t>(load_be(mdhd, at, 4));
  }

  void read_entry(const std::string& stsd) {
    track_.is_telemetry = stsd.size() >= 16 && load_be(stsd, 12, 4) == key_of("gpmd");
  }

  void finish_track();

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::kLimit, {.code = "E-LIMIT",
                                   .message = what,
                                   .where = input_.name(),
                                   .effect = "nothing written",
                                   .next = "the file is damaged, or no recording of a camera"});
  }

  const Input& input_;
  Telemetry& found_;
  Track track_;
  int boxes_ = 0;
};

/// Rows of `width` bytes after a head of `head` bytes whose last four count them; never more than there are.
std::size_t rows_in(const std::string& table, std::size_t head, std::size_t width) {
  if (table.size() < head) return 0;
  return std::min<std::size_t>(load_be(table, head - 4, 4), (table.size() - head) / width);
}

std::vector<std::uint32_t> sizes_of(const std::string& table) {
  std::vector<std::uint32_t> sizes;
  if (table.size() < 12 || load_be(table, 4, 4) != 0) return sizes;  // telemetry has no fixed size
  for (std::size_t i = 0, n = rows_in(table, 12, 4); i < n; ++i) {
    sizes.push_back(static_cast<std::uint32_t>(load_be(table, 12 + 4 * i, 4)));
  }
  return sizes;
}

/// Each sample starts where its chunk does, or where the sample before it ends.
void place(const Tables& tables, bool wide, std::vector<Payload>& payloads) {
  const std::size_t width = wide ? 8 : 4;
  const std::size_t chunks = rows_in(tables.offsets, 8, width), runs = rows_in(tables.chunks, 8, 12);
  std::size_t sample = 0, run = 0;
  for (std::size_t chunk = 0; chunk < chunks && sample < payloads.size() && runs > 0; ++chunk) {
    while (run + 1 < runs && load_be(tables.chunks, 8 + 12 * (run + 1), 4) <= chunk + 1) ++run;
    std::uint64_t offset = load_be(tables.offsets, 8 + width * chunk, width);
    const std::uint64_t count = load_be(tables.chunks, 8 + 12 * run + 4, 4);
    for (std::uint64_t i = 0; i < count && sample < payloads.size(); ++i, ++sample) {
      payloads[sample].offset = offset;
      offset += payloads[sample].size;  // wraps at worst: the reader checks offset and size against the file
    }
  }
  payloads.resize(sample);
}

void set_times(const std::string& table, double timescale, std::vector<Payload>& payloads) {
  const std::size_t runs = rows_in(table, 8, 8);
  std::uint64_t ticks = 0;
  std::size_t sample = 0;
  for (std::size_t run = 0; run < runs && sample < payloads.size(); ++run) {
    const std::uint64_t count = load_be(table, 8 + 8 * run, 4), step = load_be(table, 12 + 8 * run, 4);
    for (std::uint64_t i = 0; i < count && sample < payloads.size(); ++i, ++sample) {
      payloads[sample].start_s = static_cast<double>(ticks) / timescale;
      ticks += step;
      payloads[sample].end_s = static_cast<double>(ticks) / timescale;
    }
  }
  payloads.resize(sample);
}

void Walk::finish_track() {
  if (!track_.is_telemetry || !found_.payloads.empty()) return;
  const Tables tables{table(track_.times), table(track_.chunks), table(track_.sizes), table(track_.offsets)};
  for (const std::uint32_t size : sizes_of(tables.sizes)) found_.payloads.push_back({.size = size});
  const std::size_t claimed = found_.payloads.size();
  place(tables, track_.wide, found_.payloads);
  if (track_.timescale > 0) set_times(tables.times, track_.timescale, found_.payloads);
  if (track_.timescale == 0 || found_.payloads.size() < claimed) found_.damaged = true;
  if (track_.timescale == 0) found_.payloads.clear();
}

}  // namespace

Telemetry find_telemetry(const Input& input) {
  Telemetry found;
  Walk(input, found).boxes(0, input.size(), 0);
  return found;
}

bool recognizes(Bytes head) { return head.size() >= 8 && as_text(head.subspan(4, 4)) == "ftyp"; }

}  // namespace vispline::mp4
