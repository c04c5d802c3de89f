#include "vispline/bags/bag.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace vispline {
namespace {

constexpr std::size_t kMaxLostSpans = 10'000;
constexpr std::uint64_t kReportEvery = std::uint64_t{1} << 20;

/// Stamps may stand anywhere in 64 bits, so the difference is taken as double.
double seconds_between(std::int64_t begin_ns, std::int64_t end_ns) {
  return (static_cast<double>(end_ns) - static_cast<double>(begin_ns)) * 1e-9;
}

std::string seconds_text(double seconds) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  return text;
}

}  // namespace

void BagReader::read(const TopicFilter& wanted, const MessageSink& sink) {
  diagnostics_ = opening_;
  lost_ = lost_at_opening_;
  counts_ = {};
  first_ns_.reset();
  last_ns_.reset();
  open_loss_.reset();
  next_report_ = 0;
  std::vector<bool> is_wanted;
  for (const Topic& topic : topics_) is_wanted.push_back(wanted(topic));
  sink_ = &sink;
  read_all(is_wanted);
  sink_ = nullptr;
  refuse_if_much_is_lost();
}

bool BagReader::deliver(const Message& message) {
  ++counts_.read;
  ++counts_.kept;
  if (open_loss_) lost_[*std::exchange(open_loss_, std::nullopt)].end_ns = message.receive_ns;
  if (!first_ns_ || message.receive_ns < *first_ns_) first_ns_ = message.receive_ns;
  if (!last_ns_ || message.receive_ns > *last_ns_) last_ns_ = message.receive_ns;
  return (*sink_)(message);
}

void BagReader::drop(const std::string& code, const std::string& message, const std::string& where) {
  ++counts_.read;
  ++counts_.dropped[code];
  warn(code, message, where, "this message is left out");
}

void BagReader::lose(LostSpan span, const std::string& code, const std::string& message, const std::string& where,
                     const std::string& effect) {
  std::string loss = effect + "; " + std::to_string(span.bytes) + " bytes lost";
  if (span.begin_ns && span.end_ns) {
    loss += ", " + seconds_text(seconds_between(*span.begin_ns, *span.end_ns));
  }
  warn(code, message, where, loss);
  if (lost_.size() >= kMaxLostSpans) return;
  if (sink_ != nullptr && !span.end_ns) {
    if (!span.begin_ns) span.begin_ns = last_ns_;
    open_loss_ = lost_.size();
  }
  lost_.push_back(span);
}

void BagReader::warn(const std::string& code, const std::string& message, const std::string& where,
                     const std::string& effect) {
  diagnostics_.add({.code = code, .message = message, .where = where, .effect = effect, .next = ""});
}

bool BagReader::report_progress(std::uint64_t done, std::uint64_t total) {
  if (!options_.progress || (done < next_report_ && done < total)) return true;
  next_report_ = done + kReportEvery;
  return options_.progress(done, total);
}

void BagReader::absorb(const BagReader& part, bool opening) {
  diagnostics_.merge(part.diagnostics());
  if (opening) return;
  for (const auto& [code, count] : part.counts().dropped) {
    counts_.dropped[code] += count;
    counts_.read += count;
  }
  const std::size_t room = kMaxLostSpans - std::min(kMaxLostSpans, lost_.size());
  const auto end = part.lost().begin() + static_cast<std::ptrdiff_t>(std::min(room, part.lost().size()));
  lost_.insert(lost_.end(), part.lost().begin(), end);
}

void BagReader::keep_warnings_of_opening() {
  opening_ = diagnostics_;
  lost_at_opening_ = lost_;
}

void BagReader::refuse_if_much_is_lost() const {
  if (options_.repair || !first_ns_) return;
  double lost = 0.0;
  for (const LostSpan& span : lost_) {
    if (span.begin_ns && span.end_ns) lost += seconds_between(*span.begin_ns, *span.end_ns);
  }
  const double whole = seconds_between(*first_ns_, *last_ns_);
  if (lost <= 0.01 * whole) return;
  throw Error(ExitCode::kInput,
              {.code = "E-CHUNK",
               .message = "damage cost " + seconds_text(lost) + " of " + seconds_text(whole) + ", more than 1 %",
               .where = diagnostics_.examples().empty() ? "" : diagnostics_.examples().back().where,
               .effect = std::to_string(counts_.kept) + " messages could be read",
               .next = "pass --repair to work with the rest"});
}

std::string place(const std::string& name, std::uint64_t offset) { return name + ", byte " + std::to_string(offset); }

void fail_corrupt(const std::string& where, const std::string& message) {
  throw Error(ExitCode::kInput, {.code = "E-CORRUPT",
                                 .message = message,
                                 .where = where,
                                 .effect = "the file is not read",
                                 .next = "get the file again, or pass --repair to take what stands before this place"});
}

void fail_unsupported(const std::string& where, const std::string& message, const std::string& next) {
  throw Error(ExitCode::kInput,
              {.code = "E-UNSUPPORTED", .message = message, .where = where, .effect = "nothing read", .next = next});
}

void fail_limit(const std::string& where, const std::string& message) {
  throw Error(ExitCode::kLimit,
              {.code = "E-LIMIT", .message = message, .where = where, .effect = "nothing read", .next = ""});
}

}  // namespace vispline
