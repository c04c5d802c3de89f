#include "vispline/io/recorders.h"

#include <array>

#include "vispline/bags/input.h"
#include "vispline/io/gopro.h"
#include "vispline/io/ulog.h"

namespace vispline {
namespace {

struct Recorder {
  std::string_view name;
  bool (*recognizes)(Bytes head);
  ImuStreamResult (*stream)(const Input&, const ReadOptions&, const ImuSink&, const ImuStreamSettings&);
};

constexpr std::array kRecorders = {
    Recorder{gopro::kName, gopro::recognizes, gopro::stream},
    Recorder{ulog::kName, ulog::recognizes, ulog::stream},
};

const Recorder* recorder_of(const Input& input, const ReadOptions& options) {
  const std::string head = input.head(16);
  for (const Recorder& recorder : kRecorders) {
    if (recorder.recognizes(as_bytes(head)) && (options.format.empty() || options.format == recorder.name)) {
      return &recorder;
    }
  }
  return nullptr;
}

}  // namespace

bool is_recorder(const std::string& path, const ReadOptions& options) {
  try {
    return recorder_of(Input::open(path), options) != nullptr;
  } catch (const Error&) {
    return false;  // the reader of text says why it cannot be opened
  }
}

ImuStreamResult stream_recorder(const std::string& path, const ReadOptions& options, const ImuSink& sink,
                                const ImuStreamSettings& settings) {
  const Input input = Input::open(path);
  const Recorder* recorder = recorder_of(input, options);
  require(recorder != nullptr, "a recording of a known device");
  return recorder->stream(input, options, sink, settings);
}

std::string recorder_names() {
  std::string names;
  for (const Recorder& recorder : kRecorders) names += (names.empty() ? "" : ", ") + std::string(recorder.name);
  return names;
}

}  // namespace vispline
