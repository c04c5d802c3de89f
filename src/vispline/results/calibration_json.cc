#include <limits>

#include "vispline/results/calibration_documents.h"

namespace vispline {
namespace {

constexpr double kNull = std::numeric_limits<double>::quiet_NaN();

template <class Of>
std::vector<double> numbers(const EstimatedParameter& parameter, const Of& of) {
  std::vector<double> list;
  for (const ParameterComponent& component : parameter.components) list.push_back(of(component));
  return list;
}

JsonObject to_json(const EstimatedParameter& parameter) {
  using Component = ParameterComponent;
  std::vector<std::string> names, units, observable;
  bool known = false;
  for (const Component& component : parameter.components) {
    names.push_back(component.name);
    units.push_back(component.unit);
    if (!component.observable()) observable.push_back(component.name);
    known |= component.truth.has_value();
  }
  JsonObject object;
  object.set("name", parameter.name);
  object.set("value", numbers(parameter, [](const Component& c) { return c.observable() ? c.value : kNull; }));
  object.set("sigma", numbers(parameter, [](const Component& c) { return c.sigma; }));
  object.set("unit", parameter.unit).set("components", names);
  if (parameter.unit == "px, 1") object.set("units", units);
  object.set("start", numbers(parameter, [](const Component& c) { return c.start; }));
  object.set("prior_sigma", parameter.prior_sigma);
  object.set("sigma_limit", numbers(parameter, [](const Component& c) { return c.limit; }));
  object.set("not_observable", observable);
  if (!known) return object;
  object.set("truth", numbers(parameter, [](const Component& c) { return c.truth.value_or(kNull); }));
  return object.set("error", numbers(parameter, [](const Component& c) { return c.error.value_or(kNull); }));
}

JsonObject to_json(const SensorResiduals& r) {
  JsonObject object;
  object.set("sensor", r.sensor).set("count", r.count).set("rms", r.rms).set("unit", r.unit);
  object.set("chi2_per_dof", r.chi2_per_dof).set("dof", r.dof).set("sigma", r.sigma).set("rig_sigma", r.rig_sigma);
  object.set("lag1", r.lag1).set("lag1_band", std::vector<double>{r.lag1_low, r.lag1_high});
  return object.set("outliers", r.outliers).set("lost", r.lost);
}

JsonObject to_json(const WeakDirection& weak) {
  JsonObject object, part;
  for (const auto& [name, sigma] : weak.part) part.set(name, sigma);
  object.set("measured", weak.measured).set("words", weak.words).set("remedy", weak.remedy);
  return object.set("sigma_per_limit", weak.sigma_limits).set("one_sigma", part);
}

JsonObject to_json(const HeldParameter& held) {
  JsonObject object;
  object.set("name", held.name).set("unit", held.unit).set("share", held.share);
  return object.set("change", held.change).set("sigma", held.sigma);
}

JsonObject to_json(const InitialisationStage& stage) {
  JsonObject object;
  object.set("name", stage.name).set("passed", stage.passed).set("value", stage.value).set("limit", stage.limit);
  return object.set("unit", stage.unit).set("words", stage.words);
}

JsonObject to_json(const ComponentSpread& c) {
  JsonObject object;
  return object.set("name", c.label).set("unit", c.unit).set("sigma", c.sigma).set("spread", c.spread);
}

JsonObject to_json(const Jackknife& jackknife) {
  JsonObject object;
  std::vector<JsonObject> components;
  for (const ComponentSpread& c : jackknife.components) components.push_back(to_json(c));
  return object.set("blocks", jackknife.blocks).set("numbers", components);
}

JsonObject to_json(const Twin& twin) {
  JsonObject object;
  std::vector<JsonObject> components;
  for (const ComponentSpread& c : twin.components) components.push_back(to_json(c).set("coverage", c.coverage));
  object.set("runs", twin.runs).set("failed", twin.failed).set("states", twin.states).set("nees", twin.nees);
  object.set("nees_band", std::vector<double>{twin.nees_low, twin.nees_high}).set("consistent", twin.consistent());
  return object.set("coverage", twin.coverage).set("numbers", components);
}

JsonObject correlation(const CalibrationResult& result) {
  std::vector<std::vector<double>> rows;
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    const Eigen::VectorXd row = result.correlation.row(i);
    rows.emplace_back(row.data(), row.data() + row.size());
  }
  JsonObject object;
  return object.set("labels", result.correlation_labels).set("matrix", rows);
}

template <class T>
std::vector<JsonObject> list(const std::vector<T>& values) {
  std::vector<JsonObject> objects;
  for (const T& value : values) objects.push_back(to_json(value));
  return objects;
}

}  // namespace

std::string calibration_json(const CalibrationResult& result, const JsonContext& context) {
  JsonObject document = begin_document("vispline.result/1", context);
  document.set("class", to_name(result.result_class)).set("reasons", result.reasons);
  document.set("parameters", list(result.parameters)).set("fixed", result.fixed);
  document.set("held", list(result.held)).set("residuals", list(result.residuals));
  document.set("weak_directions", list(result.weak)).set("initialisation", list(result.stages));
  document.set("correlation", correlation(result)).set("condition", result.condition);
  if (result.nees) document.set("nees", *result.nees);
  document.set("gradient_sigmas", result.gradient_sigmas);
  document.set("curvature", std::vector<double>{result.curvature_low, result.curvature_high});
  JsonObject knots, cpu;
  knots.set("kind", result.knots.kind).set("order", result.knots.order);
  document.set("knots", knots.set("spacing_s", result.knots.spacing_s).set("why", result.knots.why));
  if (result.trajectory) {
    JsonObject truth;
    truth.set("pairs", static_cast<std::int64_t>(result.trajectory->association.pairs.size()));
    truth.set("rmse_m", result.trajectory->position_m.rmse).set("max_m", result.trajectory->position_m.max);
    document.set("ate", truth.set("rotation_rmse_deg", result.trajectory->rotation_rmse_deg));
  }
  if (result.jackknife) document.set("jackknife", to_json(*result.jackknife));
  if (result.twin) document.set("twin", to_json(*result.twin));
  document.set("first_cost", result.first_cost).set("cost", result.cost).set("iterations", result.iterations);
  for (const auto& [stage, seconds] : result.cpu_s) cpu.set(stage, seconds);
  document.set("cpu_s", cpu);
  end_document(document, context, result.diagnostics);
  return document.text();
}

}  // namespace vispline
