#include <array>

#include "vispline/results/allan_documents.h"
#include "vispline/results/allan_summary.h"
#include "vispline/results/allan_words.h"

namespace vispline {
namespace {

constexpr double kConfidence = 0.95;
constexpr std::array kOrder{Term::kWhite, Term::kRandomWalk, Term::kFlicker, Term::kQuantization, Term::kRamp};

/// A quantity that cannot be zero: zero says that it was not found.
std::optional<double> found(double value) { return value > 0.0 ? std::optional(value) : std::nullopt; }

std::optional<double> only_if(bool condition, double value) { return condition ? std::optional(value) : std::nullopt; }

JsonObject to_json(const TermEstimate& e, Term term, const SignalAnalysis& signal, double rate_hz) {
  const bool known = e.resolved;
  const auto value = only_if(known, e.value);
  JsonObject object;
  object.set("value", value).set("low", only_if(known, e.low_95)).set("high", only_if(known, e.high_95));
  object.set("confidence", kConfidence).set("unit", unit_of(term, signal.unit)).set("resolved", known);
  object.set("low_68", only_if(known, e.low_68)).set("high_68", only_if(known, e.high_68));
  object.set("upper_bound", known ? std::nullopt : e.upper_bound);
  object.set("record_needed_s", known ? std::nullopt : e.record_needed_s);
  object.set("significance", only_if(!signal.constant, e.significance));
  if (term == Term::kWhite || term == Term::kRandomWalk) {
    object.set("discrete_sigma", discrete_sigma(term, value, rate_hz));
  }
  return object;
}

JsonObject to_json(const AllanCurve& curve, const SignalAnalysis& signal) {
  JsonObject object;
  object.set("deviation", name_of(curve.deviation)).set("unit", curve_unit(curve.deviation, signal.unit));
  object.set("confidence", kCurveConfidence).set("exact", curve.exact);
  object.set("tau_s", curve.tau_s).set("value", curve.value).set("low", curve.low).set("high", curve.high);
  return object.set("edf", curve.edf).set("count", curve.count);
}

JsonObject to_json(const MinimumDeviation& minimum) {
  JsonObject object;
  return object.set("tau_s", found(minimum.tau_s)).set("deviation", found(minimum.deviation));
}

JsonObject to_json(const ImuUtilsNumbers& numbers) {
  JsonObject object;
  object.set("n", found(numbers.n)).set("w", found(numbers.w));
  return object.set("w_tau_s", found(numbers.w_tau_s));
}

std::vector<JsonObject> to_json(const std::vector<ModelMisfit>& misfits) {
  std::vector<JsonObject> objects;
  for (const ModelMisfit& m : misfits) {
    objects.emplace_back().set("low_hz", m.low_hz).set("high_hz", m.high_hz).set("ratio", m.ratio);
  }
  return objects;
}

JsonObject to_json(const SignalAnalysis& signal, double rate_hz) {
  JsonObject object, terms;
  for (const Term term : kOrder) terms.set(name_of(term), to_json(signal.terms[term], term, signal, rate_hz));
  std::vector<JsonObject> curves;
  for (const AllanCurve& curve : signal.curves) curves.push_back(to_json(curve, signal));
  object.set("sensor", signal.sensor).set("axis", signal.axis).set("unit", signal.unit);
  object.set("mean", signal.mean).set("standard_deviation", signal.standard_deviation);
  object.set("constant", signal.constant).set("terms", terms);
  object.set("tau_star_s", signal.terms.tau_star_s()).set("minimum", to_json(signal.minimum));
  object.set("imu_utils", to_json(signal.imu_utils)).set("misfits", to_json(signal.misfits));
  return object.set("curves", curves);
}

JsonObject to_json(const TermSummary& summary, Term term, const SensorSummary& sensor, double rate_hz) {
  JsonObject object;
  object.set("mean", summary.mean).set("worst", summary.worst).set("unit", unit_of(term, sensor.unit));
  object.set("worst_axis", summary.worst_axis).set("resolved", summary.resolved());
  object.set("resolved_axes", static_cast<std::int64_t>(summary.resolved_axes.size()));
  object.set("unresolved_axes", static_cast<std::int64_t>(summary.unresolved_axes.size()));
  object.set("upper_bound", summary.upper_bound).set("record_needed_s", summary.record_needed_s);
  if (term == Term::kWhite || term == Term::kRandomWalk) {
    object.set("discrete_sigma_mean", discrete_sigma(term, summary.mean, rate_hz));
    object.set("discrete_sigma_worst", discrete_sigma(term, summary.worst, rate_hz));
  }
  return object;
}

JsonObject summary_json(const AllanResult& result) {
  JsonObject document;
  for (const SensorSummary& sensor : summarize(result)) {
    JsonObject object, imu_utils;
    for (const Term term : kOrder) object.set(name_of(term), to_json(sensor[term], term, sensor, result.rate_hz));
    imu_utils.set("n", sensor.imu_utils_n).set("w", sensor.imu_utils_w);
    document.set(sensor.sensor, object.set("imu_utils", imu_utils));
  }
  return document;
}

}  // namespace

std::string allan_json(const AllanResult& result, const JsonContext& context) {
  JsonObject document = begin_document("vispline.allan/1", context);
  document.set("rate_hz", result.rate_hz).set("duration_s", result.duration_s);
  document.set("samples", result.samples).set("segments", result.segments);
  std::vector<JsonObject> signals;
  for (const SignalAnalysis& signal : result.signals) signals.push_back(to_json(signal, result.rate_hz));
  document.set("summary", summary_json(result)).set("signals", signals);
  end_document(document, context, result.diagnostics);
  return document.text();
}

}  // namespace vispline
