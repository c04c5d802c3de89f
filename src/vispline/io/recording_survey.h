/// What is in a recording of messages: every topic, its messages and their rhythm. One pass in constant memory.
#pragma once

#include <string>
#include <vector>

#include "vispline/bags/bag.h"
#include "vispline/io/message_clock.h"
#include "vispline/io/read_options.h"
#include "vispline/io/rhythm.h"
#include "vispline/io/text_lines.h"

namespace vispline {

/// What of ours reads a topic.
enum class TopicUse { kNone, kImu, kPoses, kImages };

struct TopicSurvey {
  std::string name, type, encoding;  ///< the type in the words of the file
  TopicUse use = TopicUse::kNone;
  std::uint64_t bytes = 0;          ///< of its messages
  Rhythm receive;                   ///< of the times of arrival
  std::int64_t undecoded = 0;       ///< messages that are none of the type
  std::optional<Rhythm> header;     ///< of the stamps of the headers, where the type is known
  std::optional<StampDelay> delay;  ///< header minus arrival
};

struct RecordingSurvey {
  bool indexed = false;
  std::vector<TopicSurvey> topics;  ///< connections of one name and type are one
  ReadCounts counts;                ///< of messages
  Diagnostics diagnostics;
  std::vector<LostSpan> lost;
};

/// Only of options.topic if it is given (E-TOPIC as choose_topic). What is lost to damage is lost, however much.
RecordingSurvey survey_recording(const std::string& path, const ReadOptions& options,
                                 const ReadProgress& progress = {});

}  // namespace vispline
