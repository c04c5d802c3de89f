#include "vispline/results/allan_summary.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace vispline {
namespace {

SensorSummary& summary_for(std::vector<SensorSummary>& sensors, const SignalAnalysis& signal) {
  const auto same = [&](const SensorSummary& s) { return s.sensor == signal.sensor && s.unit == signal.unit; };
  const auto found = std::find_if(sensors.begin(), sensors.end(), same);
  if (found != sensors.end()) return *found;
  SensorSummary& added = sensors.emplace_back();
  added.sensor = signal.sensor;
  added.unit = signal.unit;
  return added;
}

/// The larger of both, none if one of them is none; `first` starts the chain.
void take_largest(std::optional<double>& largest, const std::optional<double>& next, bool first) {
  if (first) {
    largest = next;
  } else if (largest) {
    largest = next ? std::optional(std::max(*largest, *next)) : std::nullopt;
  }
}

void add(TermSummary& summary, const std::string& axis, const TermEstimate& estimate) {
  if (!estimate.resolved) {
    const bool first = summary.unresolved_axes.empty();
    summary.unresolved_axes.push_back(axis);
    take_largest(summary.upper_bound, estimate.upper_bound, first);
    return take_largest(summary.record_needed_s, estimate.record_needed_s, first);
  }
  const auto before = static_cast<double>(summary.resolved_axes.size());
  summary.resolved_axes.push_back(axis);
  summary.mean = (summary.mean.value_or(0.0) * before + estimate.value) / (before + 1.0);
  if (summary.worst && *summary.worst >= estimate.value) return;
  summary.worst = estimate.value;
  summary.worst_axis = axis;
}

/// Mean over all axes that change; none unless each has a number.
template <class Get>
std::optional<double> mean_of(const AllanResult& result, const SensorSummary& sensor, Get get) {
  double sum = 0.0, count = 0.0;
  for (const std::size_t i : sensor.signals) {
    if (result.signals[i].constant) continue;
    const double value = get(result.signals[i].imu_utils);
    if (!(std::isfinite(value) && value > 0.0)) return std::nullopt;
    sum += value;
    count += 1.0;
  }
  return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace

std::optional<double> TermSummary::limit() const {
  if (unresolved_axes.empty()) return worst;
  if (!upper_bound) return std::nullopt;
  return std::max(*upper_bound, worst.value_or(0.0));
}

std::vector<SensorSummary> summarize(const AllanResult& result) {
  std::vector<SensorSummary> sensors;
  for (std::size_t i = 0; i < result.signals.size(); ++i) {
    const SignalAnalysis& signal = result.signals[i];
    SensorSummary& sensor = summary_for(sensors, signal);
    sensor.signals.push_back(i);
    if (signal.constant) continue;
    for (std::size_t t = 0; t < kTerms; ++t) add(sensor.term[t], signal.axis, signal.terms.term[t]);
  }
  for (SensorSummary& sensor : sensors) {
    sensor.imu_utils_n = mean_of(result, sensor, [](const ImuUtilsNumbers& n) { return n.n; });
    sensor.imu_utils_w = mean_of(result, sensor, [](const ImuUtilsNumbers& n) { return n.w; });
  }
  return sensors;
}

const AllanCurve* fitted_curve(const SignalAnalysis& signal) {
  for (const Deviation kind : {Deviation::kOadev, Deviation::kAdev, Deviation::kTotdev}) {
    for (const AllanCurve& curve : signal.curves) {
      if (curve.deviation == kind && !curve.tau_s.empty()) return &curve;
    }
  }
  return nullptr;
}

bool useful_bound(const SignalAnalysis& signal, Term term) {
  const TermEstimate& estimate = signal.terms[term];
  const AllanCurve* curve = fitted_curve(signal);
  if (estimate.resolved || !estimate.upper_bound || curve == nullptr) return false;
  const bool falling = term == Term::kQuantization || term == Term::kWhite;
  const double tau_s = falling ? curve->tau_s.front() : curve->tau_s.back();
  const double measured = falling ? curve->value.front() : curve->value.back();
  return deviation_of(term, *estimate.upper_bound, tau_s) < measured;
}

std::optional<double> discrete_sigma(Term term, const std::optional<double>& coefficient, double rate_hz) {
  if (!coefficient || !(rate_hz > 0.0)) return std::nullopt;
  if (term == Term::kWhite) return *coefficient * std::sqrt(rate_hz);
  if (term == Term::kRandomWalk) return *coefficient / std::sqrt(rate_hz);
  return std::nullopt;
}

}  // namespace vispline
