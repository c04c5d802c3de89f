#include "vispline/io/gopro.h"

#include <cmath>
#include <string>
#include <vector>

#include "vispline/io/gopro_payloads.h"
#include "vispline/io/number_text.h"
#include "vispline/io/sample_clock_fit.h"
#include "vispline/io/triad_pair.h"

namespace vispline::gopro {
namespace {

constexpr double kRounding = 1e-6;                           // s, of a clock that starts at zero
constexpr double kMaxSeconds = 4e9;                          // differences stay below 2^63 ns
constexpr std::size_t kMostPayloads = std::size_t{1} << 21;  // 24 days

/// Numbers the samples of one triad. TSMP counts on where payloads are missing.
struct SampleCount {
  std::int64_t next = 0;

  /// The number of the first sample of `triad`.
  std::int64_t take(const gpmf::Triad& triad) {
    const auto count = static_cast<std::int64_t>(triad.samples.size());
    if (triad.total && *triad.total < (std::uint64_t{1} << 40)) {
      next = std::max(next, static_cast<std::int64_t>(*triad.total) - count);
    }
    next += count;
    return next - count;
  }
};

/// What must be known of a triad before its first sample can be stamped.
struct Series {
  SampleCount count;
  std::vector<ClockPoint> stamps;    ///< by STMP
  std::vector<ClockPoint> payloads;  ///< by the times of the payloads
  std::string input, output;
  std::optional<Matrix3d> matrix;

  bool empty() const { return payloads.empty(); }

  void add(const gpmf::Triad& triad, double start_s) {
    if (triad.samples.empty()) return;
    if (empty()) {
      input = triad.input;
      output = triad.output;
      matrix = triad.matrix;
    }
    const std::int64_t first = count.take(triad);
    if (triad.stamp_us) stamps.push_back({first, 1e-6 * static_cast<double>(*triad.stamp_us)});
    payloads.push_back({first, start_s});
  }
};

struct Survey {
  Series gyro, accel;
  std::string device;
  double end_s = 0.0;  ///< of the last payload
  bool timed = true;   ///< payloads have times of an MP4
  bool damaged = false;
};

Survey survey(const ReadContext& context, const Payloads& payloads, const ReadProgress& progress) {
  Survey found;
  found.timed = payloads.is_timed();
  found.damaged = payloads.each(
      [&](const gpmf::Device& device, const mp4::Payload& payload) {
        if (!device.gyro && !device.accel) return true;
        if (found.device.empty()) found.device = device.name;
        if (device.gyro) found.gyro.add(*device.gyro, payload.start_s);
        if (device.accel) found.accel.add(*device.accel, payload.start_s);
        found.end_s = payload.end_s;
        if (std::max(found.gyro.payloads.size(), found.accel.payloads.size()) > kMostPayloads) {
          context.fail(ExitCode::kLimit, "E-LIMIT", "more than 2^21 payloads with an IMU", context.path(),
                       "cut the recording");
        }
        return true;
      },
      progress);
  return found;
}

/// The clock of a triad: STMP if there are two, else the times of the payloads and the end of the last one.
FittedClock clock_of(ReadContext& context, const Survey& found, const Series& series, const std::string& name) {
  std::optional<FittedClock> clock = fit_clock(series.stamps);
  if (!clock) {
    std::vector<ClockPoint> points = series.payloads;
    points.push_back({series.count.next, found.end_s});
    const double shift = series.stamps.empty() ? 0.0 : series.stamps[0].seconds - series.payloads[0].seconds;
    clock = fit_clock(points);
    if (clock) clock->start_s += shift;
    if (!found.timed) {
      context.warn("W-CLOCK", "the telemetry has no times", context.path(),
                   "each payload is taken for " + brief(kPayloadSeconds) + " s long, as is usual",
                   "read the video that it comes from");
    }
  }
  if (clock && clock->start_s < 0.0 && clock->start_s > -kRounding) clock->start_s = 0.0;
  const double rate = clock ? 1.0 / clock->period_s : 0.0;
  const double last = clock ? clock->start_s + clock->period_s * static_cast<double>(series.count.next) : 0.0;
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

Matrix3d axes_of(ReadContext& context, const Survey& found, const Series& series) {
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
  const char* axes = usual_axes(found.device);
  context.warn("W-AXES", "the file does not say which axis is which; camera " + vispline::quoted(found.device),
               context.path(), std::string("channels are taken as ") + axes, "--imu-axes settles it");
  return *gpmf::axes_from(axes);
}

/// Turns the samples of one triad, payload by payload, into rows.
class Rows {
 public:
  Rows(ReadContext& context, const Survey& found, const Series& series, const std::string& name)
      : clock_(clock_of(context, found, series, name)), axes_(axes_of(context, found, series)) {}

  template <class Push>
  void each(const gpmf::Triad& triad, const Push& push) {
    std::int64_t index = count_.take(triad);
    for (const Vector3d& channels : triad.samples) {
      const Vector3d value = axes_ * channels;
      const double seconds = clock_.start_s + clock_.period_s * static_cast<double>(index++);
      SensorRow row{.ns = std::llround(seconds * 1e9), .where = ++samples_};
      for (std::size_t axis = 0; axis < 3; ++axis) row.values[axis] = value[static_cast<Eigen::Index>(axis)];
      push(row);
    }
  }

 private:
  FittedClock clock_;
  Matrix3d axes_;
  SampleCount count_;
  std::int64_t samples_ = 0;
};

ImuAxes axes_present(const Series& gyro, const Series& accel) {
  const bool g = !gyro.empty(), a = !accel.empty();
  return {.present = {g, g, g, a, a, a}};
}

void push_all(ReadContext& context, const Payloads& payloads, const Survey& found, const ReadProgress& progress,
              TriadStream& stream) {
  std::optional<Rows> gyro, accel;
  if (!found.gyro.empty()) gyro.emplace(context, found, found.gyro, "gyroscope");
  if (!found.accel.empty()) accel.emplace(context, found, found.accel, "accelerometer");
  payloads.each(
      [&](const gpmf::Device& device, const mp4::Payload&) {
        if (gyro && device.gyro) gyro->each(*device.gyro, [&](const SensorRow& row) { stream.push_gyro(row); });
        if (accel && device.accel) accel->each(*device.accel, [&](const SensorRow& row) { stream.push_accel(row); });
        return true;
      },
      progress);
}

}  // namespace

bool recognizes(Bytes head) {
  return mp4::recognizes(head) || (head.size() >= 5 && as_text(head.first(5)) == std::string_view("DEVC\0", 5));
}

ImuStreamResult stream(const Input& input, const ReadOptions& options, const ImuSink& sink,
                       const ImuStreamSettings& settings) {
  ReadContext context(input.name(), "IMU samples", options), accel_context(input.name(), "IMU samples", options);
  context.name_places(", sample ");
  accel_context.name_places(", accelerometer sample ");
  const Payloads payloads(input);
  if (!payloads.has_track() && payloads.is_damaged()) {
    context.fail(ExitCode::kInput, "E-CORRUPT", "the video is cut or damaged, and what is left has no gpmd track",
                 context.path(), "get the file again, or mend its index with a tool for MP4");
  }
  if (!payloads.has_track()) {
    context.fail(ExitCode::kInput, "E-FORMAT", "a video without a gpmd track", context.path(),
                 "only GoPro videos carry the readings of an IMU in a form that is known");
  }
  const Survey found = survey(context, payloads, part_of(settings.progress, 0, 2));
  const ImuAxes axes = axes_present(found.gyro, found.accel);
  if (!axes.has_gyro() && !axes.has_accel()) {
    context.fail(ExitCode::kInput, "E-EMPTY", "no IMU samples in the telemetry", context.path(),
                 "give a recording of a camera with an IMU");
  }
  TriadStream stream(context, accel_context, sink, axes, settings.whole_imu, settings.window_rows);
  if (found.damaged) {
    context.warn("W-CORRUPT", "part of the telemetry is damaged or cut", context.path(), "that part is left out");
  }
  push_all(context, payloads, found, part_of(settings.progress, 1, 2), stream);
  stream.finish("the telemetry is damaged");
  return {.counts = std::move(context.counts),
          .diagnostics = std::move(context.diagnostics),
          .format = std::string(kName),
          .axes = axes,
          .largest_window = stream.largest_window(),
          .late = context.late};
}

std::optional<Readout> readout(const Input& input) {
  std::optional<Readout> found;
  const auto take = [&](const gpmf::Device& device, const mp4::Payload&) {
    if (device.readout_s.value_or(0.0) > 0.0) found = Readout{*device.readout_s, "SROT"};
    return !found;
  };
  const Payloads payloads(input);
  bool cut = false;
  for (const gpmf::Device& device : gpmf::parse(as_bytes(payloads.settings()), cut)) {
    if (!take(device, {})) return found;
  }
  payloads.each(take);
  return found;
}

}  // namespace vispline::gopro
