#include "vispline/bags/rosbag2_folder.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "vispline/bags/chunk_codec.h"
#include "vispline/bags/input.h"
#include "vispline/bags/open_bag.h"
#include "vispline/bags/rosbag2_metadata.h"
#include "vispline/files/limits.h"

namespace vispline {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_path(const std::string& folder, const std::string& file, const std::string& why) {
  throw Error(ExitCode::kInput, {.code = "E-PATH",
                                 .message = "listed file " + vispline::quoted(file) + " " + why,
                                 .where = folder + "/" + kMetadataName,
                                 .effect = "nothing read",
                                 .next = "put the files of the recording into its folder"});
}

bool is_recording(const fs::path& path) {
  const fs::path plain = path.extension() == ".zstd" ? path.stem() : path;
  return plain.extension() == ".db3" || plain.extension() == ".mcap";
}

/// By length first, so that _10 stands behind _9.
std::vector<std::string> recordings_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (is_recording(it->path())) files.push_back(it->path().filename().string());
  }
  std::ranges::sort(files,
                    [](const auto& a, const auto& b) { return std::pair(a.size(), a) < std::pair(b.size(), b); });
  return files;
}

/// The place of a listed file, links followed, which must be below the folder. Old files name the folder as well.
std::string place_below(const std::string& folder, const std::string& file) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error), name(file);
  if (file.empty() || file.find('\0') != std::string::npos) fail_path(folder, file, "has no name");
  if (name.is_absolute() || std::ranges::find(name, "..") != name.end())
    fail_path(folder, file, "is outside the folder");
  for (const fs::path& candidate : {root / name, root / name.filename()}) {
    const fs::path place = fs::canonical(candidate, error);
    if (error) continue;
    if (*place.lexically_relative(root).begin() == "..") fail_path(folder, file, "is outside the folder");
    return place.string();
  }
  fail_path(folder, file, "is absent");
}

/// A file that has no name any more once this is gone; what has it open keeps it.
class PlainCopy {
 public:
  PlainCopy(const std::string& packed) {
    path_ = (fs::temp_directory_path() / "vispline_XXXXXX").string();
    fd_ = ::mkstemp(path_.data());
    if (fd_ < 0) fail_limit(packed, "no temporary file can be made to decompress it");
    try {
      fill(Input::open(packed));
    } catch (...) {
      remove();
      throw;
    }
  }
  ~PlainCopy() { remove(); }
  PlainCopy(const PlainCopy&) = delete;
  PlainCopy& operator=(const PlainCopy&) = delete;
  const std::string& path() const { return path_; }

 private:
  void remove() {
    ::close(fd_);
    ::unlink(path_.c_str());
  }

  void fill(const Input& packed) {
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    const auto decoder = make_decoder(Codec::kZstd);
    Window window(packed);
    ByteBuffer out;
    std::uint64_t made = 0;
    for (std::uint64_t done = 0; done < packed.size(); done += kPiece) {
      out.clear();
      if (!decoder->feed(window.view(done, kPiece), out, kChunkBytes)) {
        fail_corrupt(place(packed.name(), done), decoder->error());
      }
      made += out.size();
      if (made > limits::kExpansionBase && made - limits::kExpansionBase > limits::kExpansion * packed.size()) {
        fail_limit(packed.name(), "it grows to more than 1000 times its size and 1 GiB");
      }
      put(out.view(), packed.name());
    }
    if (!decoder->finished()) fail_corrupt(place(packed.name(), packed.size()), "the compressed file ends early");
  }

  void put(Bytes bytes, const std::string& name) {
    while (!bytes.empty()) {
      const ssize_t done = ::write(fd_, bytes.data(), bytes.size());
      if (done <= 0) fail_limit(name, "no room in the folder for temporary files to decompress it");
      bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
  }

  std::string path_;
  int fd_ = -1;
};

std::unique_ptr<BagReader> open_part(const std::string& path, const BagOptions& options) {
  if (!path.ends_with(".zstd")) return open_bag(path, options);
  const PlainCopy copy(path);
  return open_bag(copy.path(), options);
}

class FolderReader final : public BagReader {
 public:
  FolderReader(std::string folder, const BagOptions& options) : BagReader(options), folder_(std::move(folder)) {
    const Rosbag2Metadata metadata = read_metadata();
    BagOptions part_options = options;
    part_options.progress = {};
    for (const std::string& file : metadata.files) add(open_part(place_below(folder_, file), part_options));
    indexed_ = std::ranges::all_of(parts_, [](const auto& part) { return part->indexed(); });
    compare(metadata);
    keep_warnings_of_opening();
  }

 private:
  static constexpr const char* kInstead = "every .db3 and .mcap file of the folder is read, in the order of names";

  Rosbag2Metadata read_metadata() {
    const std::string path = folder_ + "/" + kMetadataName;
    Rosbag2Metadata metadata;
    if (!fs::exists(path)) {
      metadata.wrong = "there is none";
    } else {
      metadata = parse_metadata(Input::open(path).head(std::size_t{2} << 20));
    }
    if (metadata.wrong.empty()) return metadata;
    warn("W-METADATA", "metadata.yaml cannot be used: " + metadata.wrong, path, kInstead);
    return {.files = recordings_in(folder_), .messages = {}, .wrong = {}};
  }

  void add(std::unique_ptr<BagReader> part) {
    std::vector<std::size_t>& numbers = numbers_.emplace_back();
    for (const Topic& topic : part->topics()) numbers.push_back(number_of(topic));
    absorb(*part, true);
    parts_.push_back(std::move(part));
  }

  std::size_t number_of(const Topic& topic) {
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      Topic& known = topics_[i];
      if (known.name != topic.name || known.type != topic.type || known.encoding != topic.encoding) continue;
      if (known.count && topic.count) *known.count += *topic.count;
      return i;
    }
    topics_.push_back(topic);
    return topics_.size() - 1;
  }

  void compare(const Rosbag2Metadata& metadata) {
    std::int64_t count = 0;
    for (const Topic& topic : topics_) count += topic.count.value_or(0);
    if (!metadata.messages || *metadata.messages == count) return;
    warn("W-METADATA",
         "metadata.yaml counts " + std::to_string(*metadata.messages) + " messages, the files have " +
             std::to_string(count),
         folder_ + "/" + kMetadataName, "the files are believed");
  }

  void read_all(const std::vector<bool>& wanted) override {
    bool go_on = true;
    for (std::size_t i = 0; i < parts_.size() && go_on; ++i) {
      BagReader& part = *parts_[i];
      const std::vector<std::size_t>& numbers = numbers_[i];
      std::size_t next = 0;  // the filter is asked for one topic after the other
      part.read([&](const Topic&) { return wanted[numbers[next++]]; },
                [&](const Message& message) {
                  Message mine = message;
                  mine.topic = numbers[message.topic];
                  return go_on = deliver(mine);
                });
      absorb(part, false);
      go_on = go_on && report_progress(i + 1, parts_.size());
    }
  }

  std::string folder_;
  std::vector<std::unique_ptr<BagReader>> parts_;
  std::vector<std::vector<std::size_t>> numbers_;  ///< of the topics of each part
};

}  // namespace

bool is_rosbag2_folder(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error) || error) return false;
  return fs::exists(path + "/" + kMetadataName, error) || !recordings_in(path).empty();
}

std::unique_ptr<BagReader> open_rosbag2_folder(const std::string& path, const BagOptions& options) {
  return std::make_unique<FolderReader>(path, options);
}

}  // namespace vispline
