#include "vispline/io/ulog_file.h"

#include <algorithm>
#include <bit>

#include "vispline/core/error.h"

namespace vispline::ulog {
namespace {

constexpr std::size_t kMaxDefinitions = 4096;
constexpr std::size_t kMessageHead = 3;  // size, type
constexpr std::string_view kMagic("ULog\x01\x12\x35", 7);
constexpr std::string_view kSync("\x08\0S\x2f\x73\x13\x20\x25\x0c\xbb\x12", 11);
constexpr std::string_view kTypes = "BFIMPQARDLCSO";
constexpr std::size_t kSearchBytes = std::size_t{1} << 16;
constexpr std::uint64_t kProgressBytes = std::uint64_t{1} << 20;

std::size_t width_of(std::string_view type) {
  if (type == "int8_t" || type == "uint8_t" || type == "bool" || type == "char") return 1;
  if (type == "int16_t" || type == "uint16_t") return 2;
  if (type == "int32_t" || type == "uint32_t" || type == "float") return 4;
  if (type == "int64_t" || type == "uint64_t" || type == "double") return 8;
  return 0;
}

/// "float[3] gyro_rad" at `offset`, which moves on; false: the type is not a plain number.
bool read_field(std::string_view text, std::size_t& offset, std::map<std::string, Field>& fields) {
  const std::size_t blank = text.find(' ');
  if (blank == std::string_view::npos) return false;
  std::string_view type = text.substr(0, blank);
  Field field{.offset = offset};
  if (const std::size_t bracket = type.find('['); bracket != std::string_view::npos) {
    field.count = 0;
    for (const char digit : type.substr(bracket + 1)) {
      if (digit == ']') break;
      if (digit < '0' || digit > '9' || field.count > 65535) return false;
      field.count = field.count * 10 + static_cast<std::size_t>(digit - '0');
    }
    type = type.substr(0, bracket);
  }
  if (width_of(type) == 0) return false;
  field.type = std::string(type);
  offset += field.count * width_of(type);
  fields.emplace(std::string(text.substr(blank + 1)), field);
  return true;
}

std::map<std::string, Field> fields_of(std::string_view text) {
  std::map<std::string, Field> fields;
  std::size_t offset = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(';'), text.size());
    if (!read_field(text.substr(0, end), offset, fields)) break;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return fields;
}

class Walker {
 public:
  Walker(const Input& input, Subscriptions& subscriptions, const OnData& on_data)
      : input_(input), window_(input), subscriptions_(subscriptions), on_data_(on_data) {}

  Walked walk(const ReadProgress& progress) {
    const Bytes head = window_.view(0, kHeaderBytes);
    if (head.size() < kHeaderBytes || !as_text(head).starts_with(kMagic)) {
      fail(ExitCode::kInput, "E-FORMAT", "the file is no ULog");
    }
    ends_ = {input_.size()};
    std::uint64_t told = 0;
    for (std::uint64_t at = kHeaderBytes; at < input_.size();) {
      at = message(at);
      if (!progress || at - told < kProgressBytes) continue;
      told = at;
      progress(at, input_.size());
    }
    return walked_;
  }

 private:
  /// Appended data begin at their own offset: what stands before it may be cut anywhere.
  std::uint64_t region_end(std::uint64_t at) const { return *std::upper_bound(ends_.begin(), ends_.end(), at); }

  /// Reads the message at `at`; returns where the next one is.
  std::uint64_t message(std::uint64_t at) {
    const std::uint64_t end = region_end(at);
    const Bytes head = window_.view(at, kMessageHead);
    if (end - at < kMessageHead || head.size() < kMessageHead) return cut(end);
    const std::size_t size = load_le<std::uint8_t>(head.data()) + 256U * load_le<std::uint8_t>(head.data() + 1);
    const char type = static_cast<char>(head[2]);
    if (kTypes.find(type) == std::string_view::npos) return next_sync(at, end);
    if (size > end - at - kMessageHead) return cut(end);
    const Bytes body = window_.view(at + kMessageHead, size);
    if (body.size() < size) return cut(end);
    take(type, body, at);
    return at + kMessageHead + size;
  }

  std::uint64_t cut(std::uint64_t end) {
    if (end == input_.size()) walked_.truncated = true;
    return end;
  }

  std::uint64_t next_sync(std::uint64_t at, std::uint64_t end) {
    std::uint64_t from = at + 1, found = end;
    while (from < end && found == end) {
      const Bytes block =
          window_.view(from, static_cast<std::size_t>(std::min<std::uint64_t>(kSearchBytes, end - from)));
      const std::size_t place = as_text(block).find(kSync);
      if (place != std::string_view::npos) found = from + place;
      if (block.size() <= kSync.size()) break;
      from += block.size() - kSync.size() + 1;
    }
    walked_.corrupt_bytes += found - at;
    return found;
  }

  void take(char type, Bytes body, std::uint64_t at) {
    if (type == 'B' && at == kHeaderBytes) read_flags(body);
    if (type == 'F') read_format(as_text(body));
    if (type == 'A') read_subscription(body);
    if (type != 'D' || body.size() < 2) return;
    const auto topic = subscriptions_.find(load_le<std::uint16_t>(body.data()));
    if (topic == subscriptions_.end()) return;
    ++topic->second.messages;
    on_data_(topic->second, body.subspan(2), at);
  }

  void read_flags(Bytes body) {
    if (body.size() < 40) return;
    for (std::size_t i = 8; i < 16; ++i) {
      const auto bits = static_cast<unsigned>(body[i]);
      if ((i == 8 ? bits & ~1U : bits) != 0) {
        fail(ExitCode::kInput, "E-UNSUPPORTED",
             "the log is of a newer kind: flag byte " + std::to_string(i - 8) + " is " + std::to_string(bits));
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto offset = load_le<std::uint64_t>(body.data() + 16 + 8 * i);
      if (offset > kHeaderBytes + kMessageHead + body.size() && offset < input_.size()) ends_.push_back(offset);
    }
    std::sort(ends_.begin(), ends_.end());
  }

  void read_format(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return;
    if (formats_.size() >= kMaxDefinitions) fail(ExitCode::kLimit, "E-LIMIT", "more than 4096 definitions");
    formats_.emplace(std::string(text.substr(0, colon)), std::string(text.substr(colon + 1)));
  }

  void read_subscription(Bytes body) {
    if (body.size() < 3) return;
    const auto id = load_le<std::uint16_t>(body.data() + 1);
    Subscription topic{.name = std::string(as_text(body.subspan(3))), .instance = static_cast<int>(body[0])};
    if (const auto format = formats_.find(topic.name); format != formats_.end()) {
      topic.fields = fields_of(format->second);
    }
    subscriptions_.emplace(id, std::move(topic));
  }

  [[noreturn]] void fail(ExitCode exit_code, const std::string& code, const std::string& message) const {
    throw Error(exit_code,
                {.code = code, .message = message, .where = input_.name(), .effect = "nothing written", .next = ""});
  }

  const Input& input_;
  Window window_;
  Subscriptions& subscriptions_;
  const OnData& on_data_;
  std::map<std::string, std::string> formats_;
  std::vector<std::uint64_t> ends_;
  Walked walked_;
};

const Field* field_of(const Subscription& topic, Bytes message, const std::string& name, std::size_t index) {
  const auto field = topic.fields.find(name);
  if (field == topic.fields.end() || index >= field->second.count) return nullptr;
  const std::size_t width = width_of(field->second.type);
  const std::size_t end = field->second.offset + (index + 1) * width;
  return end <= message.size() ? &field->second : nullptr;
}

std::uint64_t bits_of(const Field& field, Bytes message, std::size_t index) {
  const std::size_t width = width_of(field.type);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < width; ++i) {
    bits |= static_cast<std::uint64_t>(message[field.offset + index * width + i]) << (8 * i);
  }
  return bits;
}

std::int64_t integer_of(const Field& field, std::uint64_t bits) {
  if (field.type == "int8_t") return static_cast<std::int8_t>(bits);
  if (field.type == "int16_t") return static_cast<std::int16_t>(bits);
  if (field.type == "int32_t") return static_cast<std::int32_t>(bits);
  return static_cast<std::int64_t>(bits);
}

}  // namespace

Walked walk(const Input& input, Subscriptions& subscriptions, const OnData& on_data, const ReadProgress& progress) {
  return Walker(input, subscriptions, on_data).walk(progress);
}

std::optional<double> number(const Subscription& topic, Bytes message, const std::string& name, std::size_t index) {
  const Field* field = field_of(topic, message, name, index);
  if (field == nullptr) return std::nullopt;
  const std::uint64_t bits = bits_of(*field, message, index);
  if (field->type == "float") return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  if (field->type == "double") return std::bit_cast<double>(bits);
  return static_cast<double>(integer_of(*field, bits));
}

std::optional<std::int64_t> integer(const Subscription& topic, Bytes message, const std::string& name) {
  const Field* field = field_of(topic, message, name, 0);
  if (field == nullptr || field->type == "float" || field->type == "double") return std::nullopt;
  return integer_of(*field, bits_of(*field, message, 0));
}

}  // namespace vispline::ulog
