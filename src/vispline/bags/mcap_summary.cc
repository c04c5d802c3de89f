#include "vispline/bags/mcap_summary.h"

#include "vispline/bags/chunk_codec.h"

namespace vispline::mcap {
namespace {

constexpr std::uint64_t kMaxSummaryBytes = std::uint64_t{64} << 20;

void take_statistics(Bytes content, Summary& summary) {
  Fields fields(content);
  summary.messages = fields.number<std::uint64_t>();
  fields.take(2 + 4 + 4 + 4 + 4 + 8 + 8);  // schemas, channels, attachments, metadata, chunks, first and last time
  Fields counts(fields.block());
  while (counts.good() && !counts.empty()) {
    const auto channel = counts.number<std::uint16_t>();
    summary.counts[channel] = counts.number<std::uint64_t>();
  }
  if (!fields.good() || !counts.good()) summary.wrong = "its statistics are damaged";
}

void take_chunk_index(Bytes content, Summary& summary) {
  Fields fields(content);
  fields.take(16);  // first and last time
  const auto offset = fields.number<std::uint64_t>();
  fields.take(8);  // length of the chunk record
  Fields offsets(fields.block());
  std::set<std::uint16_t> channels;
  while (offsets.good() && !offsets.empty()) {
    channels.insert(offsets.number<std::uint16_t>());
    offsets.take(8);
  }
  if (!fields.good() || !offsets.good()) summary.wrong = "a chunk index is damaged";
  if (!channels.empty()) summary.chunk_channels[offset] = std::move(channels);
}

template <class Parsed>
void take(const std::optional<Parsed>& parsed, std::vector<Parsed>& to, Summary& summary) {
  if (parsed) {
    to.push_back(*parsed);
  } else {
    summary.wrong = "a schema or channel in it is damaged";
  }
}

void take_record(const Record& record, Bytes content, Summary& summary) {
  if (record.op == kSchema) take(parse_schema(content), summary.schemas, summary);
  if (record.op == kChannel) take(parse_channel(content), summary.channels, summary);
  if (record.op == kStatistics) take_statistics(content, summary);
  if (record.op == kChunkIndex) take_chunk_index(content, summary);
}

void read_records(Bytes bytes, Summary& summary) {
  Window window(bytes);
  Record record;
  Step step;
  std::uint64_t offset = 0;
  while (summary.wrong.empty() && (step = read_record(window, offset, bytes.size(), record)) != Step::kEnd) {
    if (step != Step::kRecord) {
      summary.wrong = "it is damaged";
      return;
    }
    take_record(record, window.view(record.content, static_cast<std::size_t>(record.bytes)), summary);
    offset = record.end;
  }
}

}  // namespace

Summary read_summary(const Input& input) {
  Summary summary;
  summary.data_end = input.size();
  const std::uint64_t tail = kRecordHead + kFooterBytes + kMagic.size();
  if (input.size() < kMagic.size() + tail) return summary;
  Window window(input, 4096);
  const std::uint64_t footer = input.size() - tail;
  const Bytes end = window.view(footer, static_cast<std::size_t>(tail));
  if (end.size() < tail || as_text(end.last(kMagic.size())) != kMagic) return summary;
  if (static_cast<std::uint8_t>(end[0]) != kFooter || load_le<std::uint64_t>(end.data() + 1) != kFooterBytes) {
    return summary;
  }
  const auto start = load_le<std::uint64_t>(end.data() + kRecordHead);
  const auto crc = load_le<std::uint32_t>(end.data() + kRecordHead + 16);
  summary.data_end = footer;
  if (start == 0) return summary;
  summary.wrong = "it does not stand where the footer says";
  if (start < kMagic.size() || start > footer || footer - start > kMaxSummaryBytes) return summary;
  // The CRC also covers the footer up to itself.
  const Bytes bytes = window.view(start, static_cast<std::size_t>(footer - start + kRecordHead + 16));
  if (bytes.size() < footer - start + kRecordHead + 16) return summary;
  summary.wrong = crc != 0 && crc32_of(bytes) != crc ? "its CRC differs" : "";
  if (summary.wrong.empty()) read_records(bytes.first(static_cast<std::size_t>(footer - start)), summary);
  summary.found = summary.wrong.empty();
  if (summary.found) summary.data_end = start;
  return summary;
}

}  // namespace vispline::mcap
