#include "vispline/io/gopro.h"

#include <cmath>
#include <string>
#include <vector>

#include "vispline/io/gpmf.h"
#include "vispline/io/mp4_track.h"
#include "vispline/io/number_text.h"
#include "vispline/io/sample_clock_fit.h"
#include "vispline/io/triad_pair.h"

namespace vispline::gopro {
namespace {

constexpr double kPayloadSeconds = 1.001;  // what cameras cut their telemetry into
constexpr std::uint64_t kMaxBareBytes = std::uint64_t{64} << 20;
constexpr double kMaxSeconds = 4e9;  // differences stay below 2^63 ns

/// All samples of one triad, with the points that tell its clock.
struct Series {
  std::vector<Vector3d> samples;
  std::vector<std::int64_t> index;   ///< TSMP counts on where payloads are missing
  std::vector<ClockPoint> stamps;    ///< by STMP
  std::vector<ClockPoint> payloads;  ///< by the times of the payloads
  std::string input, output;
  std::optional<Matrix3d> matrix;

  std::int64_t next_index() const { return index.empty() ? 0 : index.back() + 1; }

  void add(const gpmf::Triad& triad, double start_s) {
    if (triad.samples.empty()) return;
    if (samples.empty()) {
      input = triad.input;
      output = triad.output;
      matrix = triad.matrix;
    }
    const auto count = static_cast<std::int64_t>(triad.samples.size());
    std::int64_t first = next_index();
    if (triad.total && *triad.total < (std::uint64_t{1} << 40)) {
      const std::int64_t counted = static_cast<std::int64_t>(*triad.total) - count;
      if (counted >= first) first = counted;
    }
    if (triad.stamp_us) stamps.push_back({first, 1e-6 * static_cast<double>(*triad.stamp_us)});
    payloads.push_back({first, start_s});
    for (std::int64_t i = 0; i < count; ++i) index.push_back(first + i);
    samples.insert(samples.end(), triad.samples.begin(), triad.samples.end());
  }
};

struct Loaded {
  Series gyro, accel;
  std::string device;
  double end_s = 0.0;  ///< of the last payload
  bool timed = true;   ///< payloads have times of an MP4
  bool damaged = false;
};

void add_device(const gpmf::Device& device, double start_s, Loaded& loaded) {
  if (!device.gyro && !device.accel) return;
  if (loaded.device.empty()) loaded.device = device.name;
  if (device.gyro) loaded.gyro.add(*device.gyro, start_s);
  if (device.accel) loaded.accel.add(*device.accel, start_s);
}

std::string bytes_at(const Input& input, std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '\0');
  bytes.resize(input.read_at(offset, reinterpret_cast<std::byte*>(bytes.data()), size));
  return bytes;
}

void load_mp4(ReadContext& context, const Input& input, const ReadProgress& progress, Loaded& loaded) {
  const mp4::Telemetry telemetry = mp4::find_telemetry(input);
  loaded.damaged = telemetry.damaged;
  if (telemetry.payloads.empty()) {
    context.fail(ExitCode::kInput, "E-FORMAT", "a video without a gpmd track", context.path(),
                 "only GoPro videos carry the readings of an IMU in a form that is known");
  }
  std::uint64_t taken = 0;
  for (const mp4::Payload& payload : telemetry.payloads) {
    const bool inside = payload.offset <= input.size() && payload.size <= input.size() - payload.offset;
    taken += payload.size;
    if (taken > input.size()) {  // payloads do not overlap
      loaded.damaged = true;
      return;
    }
    if (!inside || payload.size > mp4::kMaxPayloadBytes) {
      loaded.damaged = true;
      continue;
    }
    const std::string bytes = bytes_at(input, payload.offset, payload.size);
    for (const gpmf::Device& device : gpmf::parse(as_bytes(bytes), loaded.damaged)) {
      add_device(device, payload.start_s, loaded);
    }
    require_below(context, loaded.gyro.samples.size() + loaded.accel.samples.size(), "samples");
    loaded.end_s = payload.end_s;
    if (progress) progress(payload.offset + payload.size, input.size());
  }
}

/// Payloads one after another, without a container.
void load_bare(ReadContext& context, const Input& input, Loaded& loaded) {
  if (input.size() > kMaxBareBytes) {
    context.fail(ExitCode::kLimit, "E-LIMIT", "bare telemetry of more than 64 MiB", context.path(),
                 "read the video that it comes from");
  }
  const std::string bytes = bytes_at(input, 0, static_cast<std::size_t>(input.size()));
  loaded.timed = false;
  for (const gpmf::Device& device : gpmf::parse(as_bytes(bytes), loaded.damaged)) {
    if (!device.gyro && !device.accel) continue;
    add_device(device, loaded.end_s, loaded);
    loaded.end_s += kPayloadSeconds;
  }
}

/// The clock of a triad: STMP if there are two, else the times of the payloads and the end of the last one.
FittedClock clock_of(ReadContext& context, const Loaded& loaded, Series& series, const std::string& name) {
  std::optional<FittedClock> clock = fit_clock(series.stamps);
  if (!clock) {
    std::vector<ClockPoint> points = series.payloads;
    points.push_back({series.next_index(), loaded.end_s});
    const double shift = series.stamps.empty() ? 0.0 : series.stamps[0].seconds - series.payloads[0].seconds;
    clock = fit_clock(points);
    if (clock) clock->start_s += shift;
    if (!loaded.timed) {
      context.warn("W-CLOCK", "the telemetry has no times", context.path(),
                   "each payload is taken for " + brief(kPayloadSeconds) + " s long, as is usual",
                   "read the video that it comes from");
    }
  }
  const double rate = clock ? 1.0 / clock->period_s : 0.0;
  const double last = clock ? clock->start_s + clock->period_s * static_cast<double>(series.next_index()) : 0.0;
  if (!(rate >= 1.0 && rate <= 1e5) || !(std::abs(clock->start_s) < kMaxSeconds && last < kMaxSeconds)) {
    context.fail(ExitCode::kInput, "E-TIME-UNIT", "the stamps of the " + name + " imply " + brief(rate) + " Hz",
                 context.path(), "the telemetry is damaged");
  }
  if (clock->largest_s > std::max(2.0 * clock->period_s, 0.02)) {
    context.warn("W-CLOCK",
                 "stamps of the " + name + " are up to " + brief(clock->largest_s) + " s off a steady rate of " +
                     brief(rate) + " Hz",
                 context.path(), "samples are spread at that rate");
  }
  return *clock;
}

/// By the name of the camera, where the file does not say.
const char* usual_axes(const std::string& device) {
  if (device.find("ero6") != std::string::npos || device.find("ERO6") != std::string::npos) return "YxZ";
  if (device.find("usion") != std::string::npos) return "yXZ";
  return "ZXY";
}

Matrix3d axes_of(ReadContext& context, const Loaded& loaded, const Series& series) {
  if (!context.options().imu_axes.empty()) {
    if (const auto axes = gpmf::axes_from(context.options().imu_axes)) return *axes;
    throw Error(ExitCode::kUsage,
                {.code = "E-ARGUMENT",
                 .message = "unknown axes " + vispline::quoted(context.options().imu_axes),
                 .where = "--imu-axes",
                 .effect = "nothing read",
                 .next = "give X, Y and Z in the order of the channels, small for a turned sign: YxZ"});
  }
  const auto direct = gpmf::axes_from(series.input);
  const auto after = gpmf::axes_from(series.output);
  if (direct && after && series.matrix && !(*after * *series.matrix).isApprox(*direct, 1e-6)) {
    context.warn("W-AXES", "ORIN " + vispline::quoted(series.input) + " and MTRX disagree", context.path(),
                 "ORIN is used", "--imu-axes settles it");
  }
  if (direct) return *direct;
  if (after && series.matrix) return *after * *series.matrix;
  const char* axes = usual_axes(loaded.device);
  context.warn("W-AXES", "the file does not say which axis is which; camera " + vispline::quoted(loaded.device),
               context.path(), std::string("channels are taken as ") + axes, "--imu-axes settles it");
  return *gpmf::axes_from(axes);
}

std::vector<SensorRow> rows_of(ReadContext& context, const Loaded& loaded, Series& series, const std::string& name) {
  std::vector<SensorRow> rows;
  if (series.samples.empty()) return rows;
  const FittedClock clock = clock_of(context, loaded, series, name);
  const Matrix3d axes = axes_of(context, loaded, series);
  rows.reserve(series.samples.size());
  for (std::size_t i = 0; i < series.samples.size(); ++i) {
    const Vector3d value = axes * series.samples[i];
    const double seconds = clock.start_s + clock.period_s * static_cast<double>(series.index[i]);
    SensorRow row{.ns = std::llround(seconds * 1e9), .where = static_cast<std::int64_t>(i) + 1};
    for (std::size_t axis = 0; axis < 3; ++axis) row.values[axis] = value[static_cast<Eigen::Index>(axis)];
    rows.push_back(row);
  }
  return rows;
}

ImuAxes axes_present(const Series& gyro, const Series& accel) {
  const bool g = !gyro.samples.empty(), a = !accel.samples.empty();
  return {.present = {g, g, g, a, a, a}};
}

}  // namespace

bool recognizes(Bytes head) {
  return mp4::recognizes(head) || (head.size() >= 5 && as_text(head.first(5)) == std::string_view("DEVC\0", 5));
}

ImuStreamResult stream(const Input& input, const ReadOptions& options, const ImuSink& sink,
                       const ImuStreamSettings& settings) {
  ReadContext context(input.name(), "IMU samples", options);
  context.name_places(", sample ");
  Loaded loaded;
  if (mp4::recognizes(as_bytes(input.head(16)))) {
    load_mp4(context, input, settings.progress, loaded);
  } else {
    load_bare(context, input, loaded);
  }
  const ImuAxes axes = axes_present(loaded.gyro, loaded.accel);
  if (!axes.has_gyro() && !axes.has_accel()) {
    context.fail(ExitCode::kInput, "E-EMPTY", "no IMU samples in the telemetry", context.path(),
                 "give a recording of a camera with an IMU");
  }
  require_imu(context, axes, settings.whole_imu);
  if (loaded.damaged) {
    context.warn("W-CORRUPT", "part of the telemetry is damaged or cut", context.path(), "that part is left out");
  }
  ImuScreen screen(context, sink, axes, settings.window_rows);
  const auto gyro = rows_of(context, loaded, loaded.gyro, "gyroscope");
  push_paired(context, gyro, rows_of(context, loaded, loaded.accel, "accelerometer"), screen);
  screen.flush();
  screen.finish();
  return {.counts = std::move(context.counts),
          .diagnostics = std::move(context.diagnostics),
          .format = std::string(kName),
          .axes = axes,
          .largest_window = screen.largest_window(),
          .late = context.late};
}

std::optional<Readout> readout(const Input& input) {
  const auto in_payload = [](const std::string& bytes) -> std::optional<Readout> {
    Bytes rest = as_bytes(bytes);
    bool cut = false;
    for (const gpmf::Device& device : gpmf::parse(rest, cut)) {
      if (device.readout_s.value_or(0.0) > 0.0) return Readout{*device.readout_s, "SROT"};
    }
    return std::nullopt;
  };
  if (!mp4::recognizes(as_bytes(input.head(16)))) {
    return in_payload(bytes_at(input, 0, static_cast<std::size_t>(std::min(input.size(), kMaxBareBytes))));
  }
  const mp4::Telemetry telemetry = mp4::find_telemetry(input);
  if (const auto found = in_payload(telemetry.settings)) return found;
  for (const mp4::Payload& payload : telemetry.payloads) {
    if (payload.size > mp4::kMaxPayloadBytes) continue;
    if (const auto found = in_payload(bytes_at(input, payload.offset, payload.size))) return found;
  }
  return std::nullopt;
}

}  // namespace vispline::gopro
