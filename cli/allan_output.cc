#include "allan_output.h"

#include <algorithm>
#include <cmath>

#include "flags.h"
#include "vispline/calibration/imu_utils_curves.h"
#include "vispline/calibration/noise_files.h"
#include "vispline/report/allan_section.h"
#include "vispline/results/allan_documents.h"

namespace vispline::cli {
namespace {

std::vector<const SignalAnalysis*> triad(const AllanResult& result, const std::string& sensor) {
  std::vector<const SignalAnalysis*> axes;
  for (const SignalAnalysis& signal : result.signals) {
    if (signal.sensor == sensor && !signal.constant) axes.push_back(&signal);
  }
  return axes;
}

double worst_white(const AllanResult& result, const std::string& sensor) {
  double worst = 0.0;
  for (const SignalAnalysis* axis : triad(result, sensor)) {
    worst = std::max(worst, axis->terms[Term::kWhite].value);
  }
  if (worst > 0.0) return worst;
  throw Error(ExitCode::kUnfit,
              {"E-UNRESOLVED", "no axis of the " + sensor + " shows white noise", "", "no parameter file written",
               "record a gyroscope and an accelerometer, still, for an hour"});
}

WalkEntry worst_walk(const AllanResult& result, const std::string& sensor) {
  WalkEntry walk;
  for (const SignalAnalysis* axis : triad(result, sensor)) {
    const TermEstimate& term = axis->terms[Term::kRandomWalk];
    if (term.resolved) walk.value = std::max(walk.value.value_or(0.0), term.value);
    if (term.upper_bound) walk.upper_bound = std::max(walk.upper_bound.value_or(0.0), *term.upper_bound);
  }
  return walk;
}

ImuUtilsTriad imu_utils_triad(const AllanResult& result, const std::string& sensor) {
  ImuUtilsTriad figures;
  const auto axes = triad(result, sensor);
  double w = 0.0;
  for (std::size_t a = 0; a < axes.size() && a < 3; ++a) {
    figures.axis[a] = {axes[a]->imu_utils.n, axes[a]->imu_utils.w};
    figures.average.n += axes[a]->imu_utils.n / static_cast<double>(axes.size());
    w += axes[a]->imu_utils.w / static_cast<double>(axes.size());
  }
  figures.average.w = w;
  return figures;
}

AllanTriadCurve imu_utils_curve(const AllanResult& result, const std::string& sensor) {
  AllanTriadCurve curve;
  const auto axes = triad(result, sensor);
  for (std::size_t a = 0; a < axes.size() && a < 3; ++a) {
    curve.tau_s = axes[a]->imu_utils.tau_s;
    curve.deviation[a] = axes[a]->imu_utils.measured;
    curve.fitted[a] = axes[a]->imu_utils.fitted;
  }
  return curve;
}

}  // namespace

ImuNoiseEntry noise_entry(const AllanResult& result, const std::string& topic) {
  ImuNoiseEntry entry;
  entry.gyro_white = worst_white(result, "gyroscope");
  entry.accel_white = worst_white(result, "accelerometer");
  entry.gyro_walk = worst_walk(result, "gyroscope");
  entry.accel_walk = worst_walk(result, "accelerometer");
  entry.rate_hz = result.rate_hz;
  if (!topic.empty()) entry.topic = topic;
  return entry;
}

void check_dialects(const std::vector<std::string>& dialects) {
  const std::vector<std::string> known = noise_dialects();
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
  for (const std::string& dialect : dialects) {
    require(std::find(known.begin(), known.end(), dialect) != known.end(), "--export of " + names);
  }
}

std::vector<std::string> write_allan(const std::string& dir, const AllanResult& result,
                                     const std::vector<std::string>& dialects, const std::string& topic,
                                     const std::string& title, const Session& session) {
  std::vector<std::string> next;
  std::vector<NamedText> files{{"allan.json", allan_json(result, session.context)},
                               {"curve.csv", allan_curve_csv(result)},
                               {"report.html", report::allan_page(result, title)}};
  for (const std::string& dialect : dialects) {
    const ImuNoiseEntry entry = noise_entry(result, topic);
    const ImuUtilsTables tables{imu_utils_triad(result, "gyroscope"), imu_utils_triad(result, "accelerometer")};
    files.push_back(noise_file(dialect, entry, tables));
    next.push_back(dialect + ": " + dir + "/" + files.back().file_name + ", then: " + files.back().next_command);
    if (dialect != "imu_utils") continue;
    for (NamedText& curve :
         imu_utils_curves(entry.name, imu_utils_curve(result, "gyroscope"), imu_utils_curve(result, "accelerometer"))) {
      files.push_back(std::move(curve));
    }
  }
  const OutputGuard guard;
  for (const NamedText& file : files) write_file(dir + "/" + file.file_name, file.text, output_options(session));
  return next;
}

}  // namespace vispline::cli
