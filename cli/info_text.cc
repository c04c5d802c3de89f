#include "info_document.h"
#include "vispline/io/number_text.h"
#include "vispline/io/read_context.h"
#include "vispline/results/table.h"

namespace vispline::cli {
namespace {

std::string seconds(std::int64_t ns) {
  std::string text;
  append_seconds(text, time_from_ns(ns));
  return text;
}

std::string milliseconds(std::int64_t ns) { return brief(static_cast<double>(ns) * 1e-6) + " ms"; }

std::string line(const std::string& name, const std::string& value) {
  return "  " + name + std::string(14 - name.size(), ' ') + value + "\n";
}

std::string use_name(TopicUse use) {
  switch (use) {
    case TopicUse::kImu:
      return "IMU";
    case TopicUse::kPoses:
      return "poses";
    case TopicUse::kImages:
      return "images";
    case TopicUse::kNone:
      return "not used";
  }
  return "";
}

std::string topics_text(const RecordingSurvey& recording) {
  Table table({{"topic", Table::Align::kLeft},
               {"type", Table::Align::kLeft},
               {"messages"},
               {"rate [Hz]"},
               {"gaps"},
               {"out of order"},
               {"header - arrival [ms]"},
               {"read as", Table::Align::kLeft}});
  for (const TopicSurvey& topic : recording.topics) {
    const Rhythm& rhythm = topic.header ? *topic.header : topic.receive;
    std::optional<double> delay_ms;
    if (topic.delay) delay_ms = static_cast<double>(topic.delay->median) * 1e-6;
    table.add_row({vispline::quoted(topic.name), vispline::quoted(topic.type), std::to_string(topic.receive.count),
                   number_text(topic.receive.rate_hz(), 5), std::to_string(rhythm.gaps),
                   std::to_string(rhythm.out_of_order), number_text(delay_ms, 5), use_name(topic.use)});
  }
  return std::string("recording of messages, ") + (recording.indexed ? "indexed" : "without a good index") + ", " +
         std::to_string(recording.counts.read) + " messages\n" + table.text();
}

std::string gaps_text(const Rhythm& rhythm) {
  if (rhythm.gaps == 0) return "none";
  const Gap& longest = rhythm.longest_gaps.front();
  return std::to_string(rhythm.gaps) + ", " + brief(static_cast<double>(rhythm.gaps_ns) * 1e-9) +
         " s in all, longest " + brief(static_cast<double>(longest.length_ns) * 1e-9) +
         " s after t = " + seconds(longest.after_ns) + " s";
}

std::int64_t count_of(const SignalSurvey& signal, const std::string& code) {
  const auto& counts = signal.diagnostics.counts();
  const auto found = counts.find(code);
  return found == counts.end() ? 0 : found->second;
}

std::string units_text(const SignalSurvey& signal) {
  const std::string medians = "median |gyro| " + number_text(signal.imu->median_gyro, 4) + " rad/s, |accel| " +
                              number_text(signal.imu->median_accel, 4) + " m/s^2";
  if (signal.error) return "not judged: " + medians;
  return (count_of(signal, "W-UNITS") > 0 ? "suspect: " : "plausible: ") + medians;
}

std::string imu_text(const SignalSurvey& signal) {
  Table table({{"  axis  ", Table::Align::kLeft}, {"mean"}, {"std"}, {"min"}, {"max"}, {"unit", Table::Align::kLeft}});
  for (std::size_t i = 0; i < kImuAxes; ++i) {
    if (!signal.imu->axes.present[i]) continue;
    const AxisSurvey& axis = signal.imu->axis[i];
    table.add_row({std::string(i < 3 ? "  gyro " : "  accel ") + "xyz"[i % 3], number_text(axis.mean, 5),
                   number_text(axis.standard_deviation, 5), number_text(axis.min, 5), number_text(axis.max, 5),
                   i < 3 ? "rad/s" : "m/s^2"});
  }
  return line("units", units_text(signal)) +
         line("saturated", std::to_string(count_of(signal, "W-SATURATED")) + " axes") +
         line("spikes", std::to_string(count_of(signal, "W-SPIKE"))) + table.text();
}

std::string poses_text(const PoseSurvey& poses) {
  const auto vector = [](const Vector3d& v) {
    return number_text(v.x(), 5) + ", " + number_text(v.y(), 5) + ", " + number_text(v.z(), 5);
  };
  return line("positions", "from (" + vector(poses.min_w) + ") to (" + vector(poses.max_w) + ") m") +
         line("path", number_text(poses.path_length, 5) + " m");
}

std::string signal_text(const SignalSurvey& signal) {
  const Rhythm& rhythm = signal.rhythm;
  std::string text = "\n" + (signal.name.empty() ? "" : vispline::quoted(signal.name) + ": ") +
                     (signal.imu     ? "IMU samples"
                      : signal.poses ? "poses"
                                     : "nothing that could be read") +
                     (signal.format.empty() ? "" : " (" + signal.format + ")") + "\n";
  const std::string refused =
      signal.error ? line("refused", signal.error->diagnostic().code + ": " + signal.error->diagnostic().message) : "";
  if (!signal.imu && !signal.poses && signal.error) return text + refused;
  text += line("samples", std::to_string(signal.counts.read) + " read, " + std::to_string(signal.counts.kept) +
                              " kept, " + std::to_string(signal.counts.dropped_total()) + " dropped");
  text += line("time", seconds(rhythm.begin_ns) + " s to " + seconds(rhythm.end_ns) + " s, " +
                           brief(rhythm.duration_s()) + " s");
  std::optional<double> jitter_percent;
  if (rhythm.jitter) jitter_percent = 100.0 * *rhythm.jitter;
  text += line("rate", number_text(rhythm.rate_hz(), 6) + " Hz, median step " + milliseconds(rhythm.median_step_ns) +
                           ", jitter " + number_text(jitter_percent, 3) + " %");
  text += line("order", std::to_string(signal.late) + " out of order, " +
                            std::to_string(count_of(signal, "W-DUPLICATE")) + " duplicates");
  text += line("gaps", gaps_text(rhythm));
  if (signal.delay) {
    text += line("clock", "header " + milliseconds(signal.delay->median) + " from arrival (" +
                              milliseconds(signal.delay->low) + " to " + milliseconds(signal.delay->high) + ")");
  }
  if (signal.imu) text += imu_text(signal);
  if (signal.poses) text += poses_text(*signal.poses);
  return text + refused;
}

}  // namespace

std::string info_text(const FileInfo& info) {
  std::string text = info.recording ? topics_text(*info.recording) : "";
  for (const SignalSurvey& signal : info.signals) text += signal_text(signal);
  if (info.readout) {
    text += "\ncamera\n";
    text += line("readout", number_text(info.readout->seconds, 6) + " s from the first line to the last (" +
                                info.readout->source + ")");
  }
  return text.starts_with('\n') ? text.substr(1) : text;
}

}  // namespace vispline::cli
