#include "info_document.h"

namespace vispline::cli {
namespace {

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

void set_rhythm(JsonObject& object, const Rhythm& rhythm) {
  object.set("begin_ns", rhythm.begin_ns).set("end_ns", rhythm.end_ns).set("duration_s", rhythm.duration_s());
  object.set("rate_hz", rhythm.rate_hz()).set("median_step_s", seconds(rhythm.median_step_ns));
  object.set("jitter", rhythm.jitter).set("gaps", rhythm.gaps).set("gaps_s", seconds(rhythm.gaps_ns));
  std::vector<JsonObject> gaps;
  for (const Gap& gap : rhythm.longest_gaps) {
    gaps.push_back(JsonObject().set("after_ns", gap.after_ns).set("length_s", seconds(gap.length_ns)));
  }
  object.set("longest_gaps", gaps);
}

/// Empty without messages that have both.
void set_delay(JsonObject& object, const std::optional<StampDelay>& delay) {
  JsonObject parts;
  if (delay) parts.set("low_s", seconds(delay->low)).set("median_s", seconds(delay->median));
  if (delay) parts.set("high_s", seconds(delay->high));
  object.set("header_minus_receive", parts);
}

const char* use_name(TopicUse use) {
  constexpr const char* kNames[] = {"none", "imu", "poses", "images"};
  return kNames[static_cast<int>(use)];
}

JsonObject to_json(const TopicSurvey& topic) {
  JsonObject object;
  object.set("topic", topic.name).set("type", topic.type).set("encoding", topic.encoding);
  object.set("use", use_name(topic.use)).set("messages", topic.receive.count);
  object.set("bytes", static_cast<std::int64_t>(topic.bytes)).set("undecoded", topic.undecoded);
  object.set("stamps", topic.header ? "header" : "receive");
  const Rhythm& rhythm = topic.header ? *topic.header : topic.receive;
  object.set("out_of_order", rhythm.out_of_order).set("duplicates", rhythm.duplicates);
  set_rhythm(object, rhythm);
  set_delay(object, topic.delay);
  return object;
}

std::int64_t count_of(const SignalSurvey& signal, const std::string& code) {
  const auto& counts = signal.diagnostics.counts();
  const auto found = counts.find(code);
  return found == counts.end() ? 0 : found->second;
}

JsonObject imu_json(const SignalSurvey& signal) {
  JsonObject object;
  object.set("units", signal.error ? "unknown" : count_of(signal, "W-UNITS") > 0 ? "suspect" : "plausible");
  object.set("median_gyro_rad_per_s", signal.imu->median_gyro);
  object.set("median_accel_m_per_s2", signal.imu->median_accel);
  object.set("saturated_axes", count_of(signal, "W-SATURATED")).set("spikes", count_of(signal, "W-SPIKE"));
  std::vector<JsonObject> axes;
  for (std::size_t i = 0; i < kImuAxes; ++i) {
    if (!signal.imu->axes.present[i]) continue;
    const AxisSurvey& axis = signal.imu->axis[i];
    JsonObject& each = axes.emplace_back();
    each.set("sensor", i < 3 ? "gyroscope" : "accelerometer").set("axis", std::string(1, "xyz"[i % 3]));
    each.set("unit", i < 3 ? "rad/s" : "m/s^2").set("mean", axis.mean);
    each.set("standard_deviation", axis.standard_deviation).set("min", axis.min).set("max", axis.max);
  }
  return object.set("axes", axes);
}

JsonObject to_json(const SignalSurvey& signal) {
  JsonObject object;
  object.set("name", signal.name).set("kind", signal.imu ? "imu" : (signal.poses ? "trajectory" : "none"));
  object.set("format", signal.format).set("error", signal.error ? signal.error->diagnostic().code : "");
  object.set("samples_read", signal.counts.read).set("samples_kept", signal.counts.kept);
  object.set("out_of_order", signal.late).set("duplicates", count_of(signal, "W-DUPLICATE"));
  set_rhythm(object, signal.rhythm);
  set_delay(object, signal.delay);
  if (signal.imu) object.set("imu", imu_json(signal));
  if (signal.poses) {
    JsonObject poses;
    poses.set("min_m", signal.poses->min_w).set("max_m", signal.poses->max_w);
    object.set("poses", poses.set("path_length_m", signal.poses->path_length));
  }
  return object;
}

}  // namespace

std::string info_json(const FileInfo& info, const JsonContext& context) {
  JsonObject document = begin_document("vispline.info/1", context);
  document.set("kind", info.recording ? "recording" : "table");
  document.set("indexed", info.recording && info.recording->indexed);
  std::int64_t lost = 0;
  std::vector<JsonObject> topics, signals;
  if (info.recording) {
    for (const TopicSurvey& topic : info.recording->topics) topics.push_back(to_json(topic));
    for (const LostSpan& span : info.recording->lost) lost += static_cast<std::int64_t>(span.bytes);
  }
  for (const SignalSurvey& signal : info.signals) signals.push_back(to_json(signal));
  document.set("lost_bytes", lost).set("topics", topics).set("signals", signals);
  document.set("readout_s", info.readout ? std::optional(info.readout->seconds) : std::nullopt);
  document.set("readout_source", info.readout ? info.readout->source : "");
  end_document(document, context);
  return document.text();
}

}  // namespace vispline::cli
