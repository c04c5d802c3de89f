// Any bytes as a recording of messages: samples, poses, and what a look at it tells.
#include "read_result_checks.h"
#include "vispline/io/recording_survey.h"

namespace {

using namespace vispline;

/// The survey counts every message, and no topic has more than that.
void survey(const std::string& path) {
  try {
    const RecordingSurvey found = survey_recording(path, {});
    fuzz::must(found.counts.read == found.counts.kept + found.counts.dropped_total());
    std::int64_t messages = 0;
    for (const TopicSurvey& topic : found.topics) messages += topic.receive.count;
    fuzz::must(messages == found.counts.kept);
  } catch (const Error& error) {
    fuzz::must(error.diagnostic().code.starts_with("E-"));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vispline::fuzz;
  static MemoryFile input;
  const std::string path = input.put(data, size);
  ReadResult<ImuSignal> imu;
  read_with<ImuSample>([&] { return read_imu(path); }, imu);
  read_with<ImuSample>([&] { return read_imu(path, {.clock = StampClock::kReceive, .repair = true}); }, imu);
  read_with<ImuSample>([&] { return read_imu(path, {.gyro_topic = "/imu", .accel_topic = "/accel"}); }, imu);
  ReadResult<Signal<Pose>> poses;
  read_with<Pose>([&] { return read_trajectory(path, {.repair = true}); }, poses);
  survey(path);
  return 0;
}
