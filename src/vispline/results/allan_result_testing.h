/// An Allan analysis as of a small MEMS sensor, made from formulas: some terms resolved, some only bounded.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "vispline/allan/result.h"

namespace vispline {

inline TermEstimate resolved_term(double value, double relative_68) {
  TermEstimate t;
  t.resolved = true;
  t.value = value;
  t.low_68 = value * (1.0 - relative_68);
  t.high_68 = value * (1.0 + 1.2 * relative_68);
  t.low_95 = value * (1.0 - 1.9 * relative_68);
  t.high_95 = value * (1.0 + 2.5 * relative_68);
  t.significance = 4.0 / (relative_68 * relative_68);
  return t;
}

inline TermEstimate bounded_term(double bound, double record_needed_s) {
  TermEstimate t;
  t.upper_bound = bound;
  t.record_needed_s = record_needed_s;
  t.significance = 0.4;
  return t;
}

/// 90 points from 5 ms to a third of the record, scattered about the terms as far as their intervals allow.
inline AllanCurve synthetic_curve(const NoiseTerms& truth, double rate_hz, double duration_s, double phase) {
  AllanCurve curve;
  const double last = std::log(duration_s * rate_hz / 3.0);
  for (int i = 0; i < 90; ++i) {
    const double m = std::max(std::round(std::exp(last * i / 89.0)), i + 1.0);
    const double tau = m / rate_hz;
    const double sigma = std::min(std::sqrt(0.55 * tau / duration_s), 0.4);
    const double wiggle = 0.8 * sigma * std::sin(0.9 * std::log(tau) * std::log(tau) + phase);
    const double value = truth.deviation(tau) * (1.0 + wiggle);
    curve.tau_s.push_back(tau);
    curve.value.push_back(value);
    curve.low.push_back(value * (1.0 - 0.9 * sigma));
    curve.high.push_back(value * (1.0 + 1.4 * sigma));
    curve.edf.push_back(0.5 / (sigma * sigma));
    curve.count.push_back(static_cast<std::int64_t>(duration_s * rate_hz - 2.0 * m));
  }
  curve.exact = false;
  return curve;
}

inline SignalAnalysis named_signal(const std::string& sensor, const std::string& axis, const std::string& unit) {
  SignalAnalysis signal;
  signal.sensor = sensor;
  signal.axis = axis;
  signal.unit = unit;
  return signal;
}

inline AllanResult empty_result(double rate_hz, double duration_s, std::int64_t segments) {
  AllanResult result;
  result.rate_hz = rate_hz;
  result.duration_s = duration_s;
  result.samples = static_cast<std::int64_t>(duration_s * rate_hz);
  result.segments = segments;
  return result;
}

inline SignalAnalysis synthetic_signal(const std::string& sensor, const std::string& axis, const NoiseTerms& terms,
                                       double phase) {
  SignalAnalysis s = named_signal(sensor, axis, sensor == "gyroscope" ? "rad/s" : "m/s^2");
  const double rate_hz = 200.0, duration_s = 10800.0;
  s.mean = 0.01 + 0.001 * phase;
  s.standard_deviation = terms[Term::kWhite].value * std::sqrt(rate_hz);
  s.curves = {synthetic_curve(terms, rate_hz, duration_s, phase)};
  s.terms = terms;
  const AllanCurve& curve = s.curves[0];
  std::size_t lowest = 0;
  for (std::size_t i = 0; i < curve.value.size(); ++i) {
    if (curve.value[i] < curve.value[lowest]) lowest = i;
    s.imu_utils.tau_s.push_back(curve.tau_s[i]);
    s.imu_utils.measured.push_back(1.01 * curve.value[i]);
    s.imu_utils.fitted.push_back(1.05 * terms.deviation(curve.tau_s[i]));
  }
  s.minimum = {curve.tau_s[lowest], curve.value[lowest]};
  s.imu_utils.n = 1.02 * s.standard_deviation;
  s.imu_utils.w = 1.05 * terms.deviation(s.minimum.tau_s);
  s.imu_utils.w_tau_s = s.minimum.tau_s;
  return s;
}

/// Three hours at 200 Hz, six axes, two diagnostics. K of gyroscope z and of accelerometer x is only bounded, B of
/// the gyroscope x and y too; only accelerometer z shows Q.
inline AllanResult synthetic_allan_result() {
  AllanResult result = empty_result(200.0, 10800.0, 1);
  for (int i = 0; i < 3; ++i) {
    NoiseTerms terms;
    terms[Term::kWhite] = resolved_term(1.7e-4 + 1e-5 * i, 0.003);
    terms[Term::kRandomWalk] = i < 2 ? resolved_term(2.0e-6 + 5e-7 * i, 0.12) : bounded_term(3.1e-6, 50400.0);
    terms[Term::kFlicker] = i < 2 ? bounded_term(1.5e-5, 90000.0) : resolved_term(2e-5, 0.2);
    terms[Term::kQuantization] = bounded_term(2e-7 + 1e-8 * i, 7200.0);
    terms[Term::kRamp] = bounded_term(4e-9, 3e5);
    result.signals.push_back(synthetic_signal("gyroscope", std::string(1, "xyz"[i]), terms, i));
  }
  for (int i = 0; i < 3; ++i) {
    NoiseTerms terms;
    terms[Term::kWhite] = resolved_term(2e-3 + 4e-4 * i, 0.004);
    terms[Term::kRandomWalk] = i > 0 ? resolved_term(3e-5 - 4e-6 * i, 0.2) : bounded_term(2e-5, 43200.0);
    terms[Term::kFlicker] = resolved_term(5e-4 - 1e-4 * i, 0.15);
    terms[Term::kQuantization] = i == 2 ? resolved_term(6e-5, 0.05) : bounded_term(2e-6, 14400.0);
    terms[Term::kRamp] = bounded_term(3e-7, 3e5);
    result.signals.push_back(synthetic_signal("accelerometer", std::string(1, "xyz"[i]), terms, 3.0 + i));
  }
  result.signals[4].misfits = {{50.0, 100.0, 1.8}};
  result.diagnostics.add({"W-MOTION", "the sensor moved in 2 of 10800 windows of 1 s, at 311 s and 9120 s", "imu.csv",
                          "the windows were used", "cut the record there"});
  result.diagnostics.add({"W-GAP", "1 gap of 0.25 s at 4711.5 s", "imu.csv:942301", "analysed as segments", ""});
  return result;
}

/// One axis that never changes, one series without an axis and a unit.
inline AllanResult odd_allan_result() {
  AllanResult result = empty_result(10.0, 600.0, 2);
  result.signals.push_back(named_signal("gyroscope", "x", "rad/s"));
  result.signals[0].mean = 0.5;
  result.signals[0].constant = true;
  SignalAnalysis series = named_signal("series", "", "");
  series.terms[Term::kWhite] = resolved_term(1.0, 0.02);
  series.curves = {synthetic_curve(series.terms, 10.0, 600.0, 0.0)};
  series.minimum = {200.0, series.curves[0].value.back()};
  result.signals.push_back(series);
  return result;
}

}  // namespace vispline
