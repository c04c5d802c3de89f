#include <numbers>

#include "vispline/results/documents.h"

namespace vispline {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

JsonObject to_json(const IntegrationRow& row) {
  JsonObject object;
  object.set("method", row.method).set("rate_hz", row.rate_hz);
  object.set("final_error_m", row.error.final_error_m).set("max_error_m", row.error.max_error_m);
  object.set("rmse_m", row.error.rmse_m).set("attitude_error_deg", row.error.attitude_error_deg);
  return object.set("order", row.order).set("samples", row.error.samples).set("outside", row.error.outside);
}

/// The three axes of one triad; `unit` ends the keys that have one.
std::vector<JsonObject> to_json(const std::array<AxisComparison, 3>& axes, const std::string& unit) {
  std::vector<JsonObject> objects;
  for (std::size_t i = 0; i < 3; ++i) {
    JsonObject& object = objects.emplace_back();
    object.set("axis", std::string_view("xyz").substr(i, 1)).set("rms_" + unit, axes[i].rms);
    object.set("correlation", axes[i].correlation);
    object.set("mean_" + unit, axes[i].mean).set("std_" + unit, axes[i].std);
  }
  return objects;
}

JsonObject to_json(const ErrorStatistics& s) {
  JsonObject object;
  object.set("rmse_m", s.rmse).set("mean_m", s.mean).set("median_m", s.median);
  return object.set("max_m", s.max).set("std_m", s.std);
}

JsonObject to_json(const RelativeError& error) {
  JsonObject object;
  object.set("delta", error.delta.value).set("delta_unit", error.delta.unit == DeltaUnit::kSeconds ? "s" : "m");
  object.set("pairs", error.pairs).set("translation_rmse_m", error.translation_rmse_m);
  return object.set("rotation_rmse_deg", error.rotation_rmse_deg);
}

}  // namespace

std::string integrate_json(const std::vector<IntegrationRow>& rows, const JsonContext& context) {
  JsonObject document = begin_document("vispline.integrate/1", context);
  std::vector<JsonObject> objects;
  for (const IntegrationRow& row : rows) objects.push_back(to_json(row));
  document.set("rows", objects);
  end_document(document, context);
  return document.text();
}

std::string evaluate_imu_json(const ImuComparison& c, const JsonContext& context) {
  JsonObject document = begin_document("vispline.evaluate_imu/1", context);
  document.set("aligned", c.aligned).set("time_offset_s", c.time_offset_s);
  document.set("offset_correlation", c.offset_correlation).set("offset_confidence", c.offset_confidence);
  document.set("rotation_deg", kDegrees * c.rotation_vector.norm());
  document.set("rotation_vector_rad", c.rotation_vector).set("rotation_matrix", c.R_second_first);
  document.set("gyroscope", to_json(c.gyroscope, "rad_per_s"));
  document.set("accelerometer", to_json(c.accelerometer, "m_per_s2"));
  document.set("samples_compared", c.compared).set("samples_outside", c.outside).set("samples_in_gaps", c.in_gaps);
  end_document(document, context, c.diagnostics);
  return document.text();
}

std::string evaluate_trajectory_json(const TrajectoryComparison& c, const JsonContext& context) {
  JsonObject document = begin_document("vispline.evaluate_trajectory/1", context);
  document.set("alignment", to_name(c.alignment_mode));
  document.set("scale", c.alignment.scale).set("rotation_matrix", c.alignment.R_r_e);
  document.set("translation_m", c.alignment.p_r_e);
  document.set("pairs", static_cast<std::int64_t>(c.association.pairs.size()));
  document.set("estimate_outside", c.association.estimate_outside);
  document.set("estimate_unmatched", c.association.estimate_unmatched);
  document.set("reference_unmatched", c.association.reference_unmatched);
  document.set("duration_s", c.duration_s).set("path_length_m", c.path_length_m);
  document.set(
      "ate",
      to_json(c.position_m).set("rotation_rmse_deg", c.rotation_rmse_deg).set("rotation_max_deg", c.rotation_max_deg));
  std::vector<JsonObject> relative;
  for (const RelativeError& error : c.relative) relative.push_back(to_json(error));
  document.set("rpe", relative);
  end_document(document, context, c.diagnostics);
  return document.text();
}

}  // namespace vispline
