/// What every reader of recordings owes, whatever the bytes.
#pragma once

#include <string>
#include <vector>

#include "must.h"
#include "vispline/bags/bag.h"

namespace vispline::fuzz {

struct Seen {
  bool failed = false, warned = false, indexed = false;
  std::vector<std::pair<std::int64_t, std::string>> messages;
};

template <class Open>
Seen read_with(const Open& open) {
  Seen seen;
  try {
    const auto reader = open();
    reader->read([](const Topic&) { return true; },
                 [&](const Message& message) {
                   must(message.topic < reader->topics().size());
                   seen.messages.emplace_back(message.receive_ns, as_text(message.data));
                   return true;
                 });
    must(reader->counts().read == reader->counts().kept + reader->counts().dropped_total());
    must(reader->counts().kept == static_cast<std::int64_t>(seen.messages.size()));
    seen.warned = !reader->diagnostics().empty();
    seen.indexed = reader->indexed();
  } catch (const Error&) {
    seen.failed = true;
  }
  return seen;
}

/// Two ways to one recording; `open(options)` opens it.
template <class Open>
void index_equals_scan(const Open& open) {
  const Seen by_index = read_with([&] { return open(BagOptions{}); });
  const Seen by_scan = read_with([&] { return open(BagOptions{.use_index = false}); });
  if (by_index.failed || by_scan.failed || by_index.warned || by_scan.warned || !by_index.indexed) return;
  must(by_index.messages == by_scan.messages);
  read_with([&] { return open(BagOptions{.repair = true}); });
}

}  // namespace vispline::fuzz
