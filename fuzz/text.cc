// Any bytes as a table of IMU samples or poses: what is read must survive writing and reading.
#include "read_result_checks.h"
#include "vispline/io/euroc_imu.h"

namespace {

using namespace vispline;
using namespace vispline::fuzz;

void write_and_read(MemoryFile& file, const ImuSignal& imu) {
  std::string text = std::string(euroc_imu::kHeader) + "\n";
  for (std::size_t i = 0; i < imu.size(); ++i) euroc_imu::append_row(text, imu.time[i], imu.value[i]);
  ReadResult<ImuSignal> again;
  const std::string path = file.put(text.data(), text.size());
  if (!read_with<ImuSample>([&] { return read_imu(path, {.format = "euroc_imu", .repair = true}); }, again)) return;
  if (again.counts.kept != again.counts.read) return;  // what was left out is told
  must(again.value.time == imu.time);
  for (std::size_t i = 0; i < imu.size(); ++i) {
    must(again.value.value[i].gyro == imu.value[i].gyro && again.value.value[i].accel == imu.value[i].accel);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static MemoryFile input, output;
  const std::string path = input.put(data, size);
  ReadResult<ImuSignal> imu;
  if (read_with<ImuSample>([&] { return read_imu(path); }, imu)) write_and_read(output, imu.value);
  read_with<ImuSample>([&] { return read_imu(path, {.skip_bad_rows = true, .repair = true}); }, imu);
  read_with<ImuSample>([&] { return read_imu(path, {.rate_hz = 200.0, .decimal = ','}); }, imu);
  ReadResult<Signal<Pose>> poses;
  read_with<Pose>([&] { return read_trajectory(path); }, poses);
  return 0;
}
