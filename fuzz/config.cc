// Any bytes as a parameter file: YAML, noise of an IMU, rig and board. What can be read must survive write and read.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "vispline/calibration/imu_utils_explanation.h"
#include "vispline/calibration/read_noise.h"
#include "vispline/calibration/rig_files.h"
#include "vispline/calibration/target_file.h"

namespace {

using namespace vispline;

void check(bool condition) {
  if (!condition) std::abort();
}

/// Whether `work` ended without an Error; any other exception is a finding.
template <class Work>
bool succeeds(const Work& work) {
  try {
    work();
    return true;
  } catch (const Error& error) {
    check(error.diagnostic().code.starts_with("E-"));
    return false;
  }
}

void fuzz_noise(const std::string& text) {
  NoiseReading reading;
  if (!succeeds([&] { reading = parse_noise("f", text, {.rate_hz = 200.0}); })) return;
  if (reading.tables) succeeds([&] { to_text(explain_imu_utils(*reading.tables, 200.0, 7200.0)); });
  for (const std::string& dialect : noise_dialects()) {
    NamedText file;
    if (!succeeds([&] { file = noise_file(dialect, reading.entry); })) continue;  // a figure beyond a double's range
    NoiseReading again;
    if (!succeeds([&] { again = parse_noise("f", file.text, {.rate_hz = reading.entry.rate_hz}); })) continue;
    if (dialect != "kalibr") continue;
    check(again.entry.gyro_white == reading.entry.gyro_white && again.entry.rate_hz == reading.entry.rate_hz);
    check(again.entry.topic == reading.entry.topic);
  }
}

void fuzz_rig(const std::string& text) {
  const auto sibling = [&](const std::string&) { return text; };
  RigReading reading;
  if (!succeeds([&] { reading = parse_rig("f", text, sibling, {.rate_hz = 200.0}); })) return;
  for (const std::string& dialect : rig_dialects()) {
    std::vector<NamedText> files;
    if (!succeeds([&] { files = rig_files(dialect, reading.rig); })) continue;
    if (dialect != "kalibr" || reading.rig.cameras.empty()) continue;
    const RigReading again = parse_rig("f", files[0].text, sibling);
    check(again.rig.cameras.size() == reading.rig.cameras.size());
    check(again.rig.cameras[0].intrinsics == reading.rig.cameras[0].intrinsics);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz_noise(text);
  fuzz_rig(text);
  TargetReading target;
  if (succeeds([&] { target = parse_target("f", text); })) succeeds([&] { target_file("kalibr", target.target); });
  return 0;
}
